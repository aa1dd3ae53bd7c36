#include "core/diagnosis/quality/encoder_jumps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/quantile.h"
#include "core/diagnosis/quality/part_of_run.h"

namespace odolab {

namespace {

constexpr std::size_t kAround = 3;  // readings before and behind

bool has_readings_around(const std::vector<double>& of, std::size_t i) {
  return i >= kAround && i + kAround < of.size();
}

// By how much one stands out from those before and behind it, on the same side of both, with its sign: a wheel that
// stops or sets off is like one of them.
double standing_out(const std::vector<double>& of, std::size_t i) {
  if (!has_readings_around(of, i)) return 0.0;
  const auto at = of.begin() + static_cast<std::ptrdiff_t>(i);
  const double before = median({at - kAround, at}), behind = median({at + 1, at + 1 + kAround});
  return of[i] - std::clamp(of[i], std::min(before, behind), std::max(before, behind));
}

// Of the readings of one wheel, each with the next.
struct Rates {
  std::vector<double> each, out_by;
  std::vector<double> step_rad, step_out_by_rad;
  // How large rates are, and by how much they stand out, but for a few, while the wheel turns.
  double usual = 0.0, trembles = 0.0;
  double usual_step_rad = 0.0;

  // Where the step is like its neighbours and only the rate is not, the stamp of a reading is wrong, and not its count.
  bool is_of_the_stamp(std::size_t i, double gap_s) const {
    constexpr double kOfTheRate = 0.5;
    const double by_rate_rad = out_by[i] * gap_s;
    return step_out_by_rad[i] * by_rate_rad < kOfTheRate * by_rate_rad * by_rate_rad;
  }
};

Rates rates_of(const std::vector<double>& time_s, const std::vector<double>& angle_rad) {
  constexpr double kNearlyAll = 0.97;
  Rates rates;
  for (std::size_t i = 0; i + 1 < angle_rad.size(); ++i) {
    rates.step_rad.push_back(angle_rad[i + 1] - angle_rad[i]);
    rates.each.push_back(rates.step_rad[i] / (time_s[i + 1] - time_s[i]));
  }
  if (rates.each.empty()) return rates;
  for (std::size_t i = 0; i < rates.each.size(); ++i) {
    rates.out_by.push_back(standing_out(rates.each, i));
    rates.step_out_by_rad.push_back(standing_out(rates.step_rad, i));
  }
  // A robot that waits all day drives as it does in the minute in which it drives.
  std::vector<bool> rests(rates.each.size());
  for (std::size_t i = 0, still = 0; i < rests.size(); ++i) {
    still = rates.step_rad[i] == 0.0 ? still + 1 : 0;
    if (still > 2 * kAround) rests[i - kAround] = true;
  }
  const auto size = [&](const std::vector<double>& of) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < of.size(); ++i)
      if (!rests[i]) sizes.push_back(std::abs(of[i]));
    return sizes.empty() ? 0.0 : quantile(std::move(sizes), kNearlyAll);
  };
  rates.usual = size(rates.each);
  rates.trembles = size(rates.out_by);
  rates.usual_step_rad = size(rates.step_rad);
  return rates;
}

// Where the wheel turns round: there play is crossed, as fast as a motor turns without a load.
bool turns_round(const Rates& rates, std::size_t i) {
  constexpr std::size_t kLook = 6;  // readings before and behind
  const auto turned_rad = [&](std::size_t from, std::size_t end) {
    return std::accumulate(rates.step_rad.begin() + static_cast<std::ptrdiff_t>(from),
                           rates.step_rad.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
  };
  return i >= kLook && i + kLook < rates.step_rad.size() &&
         turned_rad(i - kLook, i) * turned_rad(i + 1, i + 1 + kLook) < 0.0;
}

// Off the pace before and behind, which is steady: a wheel that slows and speeds up again takes more than so many
// readings for it. Of two in a row counts are lost that a counter did not count from within the one until within the
// next.
bool is_off_a_steady_pace(const Rates& rates, std::size_t first, std::size_t readings, double gap_s, double count_rad) {
  constexpr double kOfUsual = 0.25, kTrembles = 4.0, kCounts = 3.0, kBeside = 0.3;
  constexpr double kFarFromTrembling = 20.0;  // of counts that are lost: no bump loses any
  const std::size_t behind = first + readings;
  if (first == 0 || behind >= rates.each.size()) return false;
  const double by_first = rates.out_by[first], by_next = rates.out_by[first + 1];
  const std::size_t i = readings > 1 && std::abs(by_next) > std::abs(by_first) ? first + 1 : first;
  const double out_by = std::abs(rates.out_by[i]);
  const bool loses = rates.out_by[i] * (rates.each[i] - rates.out_by[i]) < 0.0;
  const bool both_lose =
      loses && by_first * by_next > 0.0 && std::min(std::abs(by_first), std::abs(by_next)) > kBeside * out_by;
  if ((readings > 1 && !both_lose) || turns_round(rates, i)) return false;
  const double least =
      loses ? std::min(kOfUsual * rates.usual, kFarFromTrembling * rates.trembles) : kOfUsual * rates.usual;
  return out_by >= least && out_by >= kTrembles * rates.trembles && out_by * gap_s >= kCounts * count_rad &&
         !rates.is_of_the_stamp(i, gap_s) &&
         std::max(std::abs(rates.out_by[first - 1]), std::abs(rates.out_by[behind])) <= kBeside * out_by;
}

// No count at all in one reading, of a wheel that turned before and turns behind, however slowly.
bool makes_no_count(const Rates& rates, std::size_t i, double gap_s, double count_rad) {
  constexpr double kCounts = 3.0;
  return rates.step_rad[i] == 0.0 && std::abs(rates.out_by[i]) * gap_s >= kCounts * count_rad &&
         !turns_round(rates, i);
}

// Readings in a row that stand out, of one wheel or both.
struct StandingOut {
  std::size_t first, readings;
  bool left, right;
};

// What a wheel stands out by in them until then.
double out_by_rad(const Rates& rates, const std::vector<double>& time_s, const StandingOut& out, double until_s) {
  double sum_rad = 0.0;
  for (std::size_t k = out.first; k < out.first + out.readings && time_s[k] < until_s; ++k)
    sum_rad += rates.out_by[k] * (time_s[k + 1] - time_s[k]);
  return sum_rad;
}

// How much of it the truth shows, were those readings on the pace.
std::optional<ShownShare> shown_on_the_pace(const InnovationRun& run, const InnovationModel& calibrated,
                                            const std::vector<double>& time_s, const Rates& of_left,
                                            const Rates& of_right, const StandingOut& out) {
  const InnovationRun as_read =
      part_of_run(run, time_s[out.first], time_s[out.first + out.readings], calibrated.truth.time_offset_s);
  return shown_share([&](double share) {
    InnovationRun part = as_read;
    for (WheelSample& w : part.wheels) {
      if (out.left) w.left_rad -= share * out_by_rad(of_left, time_s, out, w.time_s);
      if (out.right) w.right_rad -= share * out_by_rad(of_right, time_s, out, w.time_s);
    }
    return misfit_of(part, calibrated);
  });
}

}  // namespace

TimeStretches encoder_jumps(const std::vector<double>& time_s, const std::vector<double>& angle_rad, double radius_m,
                            double count_rad) {
  constexpr double kGap_s = 0.5;  // a step over more is no step
  constexpr double kLeast_m = 0.02;
  constexpr double kTyre_mps2 = 20.0;  // twice what a tyre can push
  constexpr double kOfItself = 0.5;    // by which a jump stands out: a wheel that goes fast for long does not
  const Rates rates = rates_of(time_s, angle_rad);
  TimeStretches jumps;
  const std::vector<double>& each = rates.each;
  for (std::size_t i = 0; i < each.size(); ++i) {
    const double gap = time_s[i + 1] - time_s[i], by = each[i] * gap;
    if (gap >= kGap_s) continue;
    const bool back_and_on =
        i > 0 && i + 1 < each.size() && each[i] * each[i - 1] < 0.0 && each[i] * each[i + 1] < 0.0;
    const bool is_like_others =
        has_readings_around(each, i) && std::abs(rates.out_by[i]) < kOfItself * std::abs(each[i]);
    const bool too_fast = (back_and_on || !is_like_others) && std::abs(by) * radius_m > kLeast_m &&
                          std::abs(by) > 1.5 * count_rad &&
                          std::abs(each[i]) > (back_and_on ? 1.0 : 4.0) * rates.usual &&
                          std::abs(by) > (back_and_on ? 0.0 : 2.0) * rates.usual_step_rad;
    // One reading off the pace that the wheel had before and has behind it, where no tyre could have pushed it.
    const double out_by = std::abs(rates.out_by[i]);
    const bool off_its_pace = out_by * gap > 4.0 * count_rad && out_by > 4.0 * rates.trembles &&
                              out_by > 0.5 * rates.usual && out_by * radius_m > kTyre_mps2 * gap &&
                              !rates.is_of_the_stamp(i, gap);
    if (too_fast || off_its_pace) jumps.push_back({time_s[i], time_s[i + 1]});
  }
  return jumps;
}

TimeStretches without_lost_rows(const TimeStretches& jumps, const std::vector<WheelSample>& wheels) {
  constexpr double kNearly = 0.25;  // of a step
  const auto steps_in = [&](std::size_t i, double WheelSample::*rad) {
    const auto step_rad = [&](std::size_t k) { return wheels[k + 1].*rad - wheels[k].*rad; };
    std::vector<double> about_rad;  // another row may be lost nearby
    for (std::size_t k = i - kAround; k <= i + kAround; ++k)
      if (k != i) about_rad.push_back(step_rad(k));
    const double pace_rad = median(std::move(about_rad));
    return pace_rad != 0.0 ? step_rad(i) / pace_rad : 0.0;
  };
  TimeStretches kept;
  for (const auto& jump : jumps) {
    const auto at = std::lower_bound(wheels.begin(), wheels.end(), jump.first,
                                     [](const WheelSample& w, double t) { return w.time_s < t; });
    const auto i = static_cast<std::size_t>(at - wheels.begin());
    if (i >= kAround && i + kAround + 1 < wheels.size()) {
      const double left = steps_in(i, &WheelSample::left_rad), right = steps_in(i, &WheelSample::right_rad);
      if (left > 1.5 && std::abs(left - std::round(left)) < kNearly && std::abs(right - std::round(left)) < kNearly)
        continue;
    }
    kept.push_back(jump);
  }
  return kept;
}

JumpsOfWheels jumps_against_truth(const InnovationRun& run, const InnovationModel& calibrated) {
  constexpr double kShown = 30.0;  // of twice the log-likelihood
  // The same where both wheels do so at once by more than 1 g, or make no count at all: no vehicle does.
  constexpr double kNoVehicle_mps2 = 9.81, kOfNoVehicle = 10.0;
  constexpr double kAllOfIt = 0.3;       // by so much at most what the truth shows may differ from what stands out
  std::vector<double> time_s, left_rad, right_rad;
  for (const WheelSample& w : run.wheels)
    time_s.push_back(w.time_s), left_rad.push_back(w.left_rad), right_rad.push_back(w.right_rad);
  const Rates of_left = rates_of(time_s, left_rad), of_right = rates_of(time_s, right_rad);
  const double count = count_rad(run, calibrated.drive);
  JumpsOfWheels jumps;
  for (std::size_t i = 1; i + 1 < of_left.each.size(); ++i)
    for (const std::size_t readings : {1u, 2u}) {
      const double gap_s = time_s[i + 1] - time_s[i];
      bool left = is_off_a_steady_pace(of_left, i, readings, gap_s, count),
           right = is_off_a_steady_pace(of_right, i, readings, gap_s, count);
      if (!left && !right) continue;
      // A packet that is lost has the counts of both.
      const bool is_a_packet = readings == 1 && makes_no_count(of_left, i, gap_s, count) &&
                               makes_no_count(of_right, i, gap_s, count);
      left |= is_a_packet, right |= is_a_packet;
      const std::optional<ShownShare> shown =
          shown_on_the_pace(run, calibrated, time_s, of_left, of_right, {i, readings, left, right});
      const double slower_radps = std::min(std::abs(of_left.out_by[i]), std::abs(of_right.out_by[i])),
                   slowed_mps2 = slower_radps * calibrated.drive.wheel_radius_left_m / gap_s;
      const bool is_no_vehicle = is_a_packet || (left && right && of_left.out_by[i] * of_right.out_by[i] > 0.0 &&
                                                 slowed_mps2 > kNoVehicle_mps2);
      if (!shown || shown->gain_of_all < (is_no_vehicle ? kOfNoVehicle : kShown)) continue;
      if (std::abs(shown->best - 1.0) >= kAllOfIt) continue;
      (left && right ? jumps.both : left ? jumps.left : jumps.right).emplace_back(time_s[i], time_s[i + readings]);
    }
  return jumps;
}

}  // namespace odolab
