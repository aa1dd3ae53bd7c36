#include "core/diagnosis/quality/lost_counts.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/quality/part_of_run.h"
#include "core/diagnosis/quality/standing_encoder.h"

namespace odolab {

namespace {

// How fast a wheel turned between two readings.
double pace_radps(const std::vector<WheelSample>& wheels, double WheelSample::*wheel, std::size_t from,
                  std::size_t to) {
  return (wheels[to].*wheel - wheels[from].*wheel) / std::max(1e-6, wheels[to].time_s - wheels[from].time_s);
}

std::size_t reading_at(const std::vector<WheelSample>& wheels, double time_s) {
  return static_cast<std::size_t>(std::lower_bound(wheels.begin(), wheels.end(), time_s,
                                                   [](const WheelSample& w, double t) { return w.time_s < t; }) -
                                  wheels.begin());
}

// Whether a wheel goes on meanwhile as it went before.
bool goes_on(const std::vector<WheelSample>& wheels, double WheelSample::*wheel,
             const std::pair<double, double>& meanwhile) {
  constexpr double kOfThePace = 0.7;
  const std::size_t first = reading_at(wheels, meanwhile.first), last = reading_at(wheels, meanwhile.second);
  return first >= kReadingsOfPace &&
         std::abs(pace_radps(wheels, wheel, first, last)) >
             kOfThePace * std::abs(pace_radps(wheels, wheel, first - kReadingsOfPace, first));
}

struct Hold {
  double from_s, to_s;
  bool left, right;
};

// Whether the truth was taken meanwhile: else the vehicle may have gone on, or been carried, at any time of a gap.
bool is_seen(const Hold& hold, const InnovationRun& run, double truth_late_s) {
  constexpr double kShort = 3.0;  // of the samples' period
  const double period_s =
      (run.truth.back().time_s - run.truth.front().time_s) / static_cast<double>(run.truth.size() - 1);
  return hold.to_s - hold.from_s < kShort * period_s ||
         std::any_of(run.truth.begin(), run.truth.end(), [&](const TruthSample& t) {
           return t.time_s - truth_late_s > hold.from_s && t.time_s - truth_late_s < hold.to_s;
         });
}

// Of both wheels where they hold at once, to a reading: that no two wheels do, however short it is. Of one for less
// than three intervals where the other goes on.
std::vector<Hold> abrupt_holds_of(const InnovationRun& run, const DifferentialDrive& drive) {
  constexpr std::size_t kLong = 3, kFewest = 1;  // intervals
  TimeStretches left = abrupt_holds(run.wheels, Wheel::left, drive, kFewest),
                right = abrupt_holds(run.wheels, Wheel::right, drive, kFewest);
  const double interval_s =
      (run.wheels.back().time_s - run.wheels.front().time_s) / static_cast<double>(run.wheels.size() - 1);
  // A stretch reaches to the reading that holds no more.
  const auto is_long = [&](const std::pair<double, double>& hold) {
    return hold.second - hold.first > (static_cast<double>(kLong) + 0.5) * interval_s;
  };
  std::vector<Hold> holds;
  for (const auto& [from_s, to_s] : left) {
    const auto same = std::find_if(right.begin(), right.end(), [&, from = from_s, to = to_s](const auto& r) {
      return std::abs(r.first - from) < 1.5 * interval_s && std::abs(r.second - to) < 1.5 * interval_s;
    });
    if (same == right.end()) {
      const std::pair hold{from_s, to_s};
      if (is_long(hold) || goes_on(run.wheels, &WheelSample::right_rad, hold))
        holds.push_back({from_s, to_s, true, false});
      continue;
    }
    holds.push_back({std::max(from_s, same->first), std::min(to_s, same->second), true, true});
    right.erase(same);
  }
  for (const auto& hold : right)
    if (is_long(hold) || goes_on(run.wheels, &WheelSample::left_rad, hold))
      holds.push_back({hold.first, hold.second, false, true});
  return holds;
}

}  // namespace

JumpsOfWheels lost_counts(const InnovationRun& run, const InnovationModel& calibrated) {
  constexpr double kShown = 30.0;                  // of twice the log-likelihood
  constexpr double kLeastOf = 0.4, kMostOf = 2.0;  // what the truth shows, of what the paces before and behind do
  JumpsOfWheels lost;
  for (const Hold& hold : abrupt_holds_of(run, calibrated.drive)) {
    if (!is_seen(hold, run, calibrated.truth.time_offset_s)) continue;
    const std::size_t first = reading_at(run.wheels, hold.from_s), last = reading_at(run.wheels, hold.to_s);
    if (first < kReadingsOfPace + 1 || last + kReadingsOfPace >= run.wheels.size()) continue;
    const double lasts_s = hold.to_s - hold.from_s;
    // The last interval before may be in part of the hold.
    const auto evenly = [&](double WheelSample::*wheel) {
      return EvenlyBetween{pace_radps(run.wheels, wheel, first - 1 - kReadingsOfPace, first - 1),
                           pace_radps(run.wheels, wheel, last, last + kReadingsOfPace), lasts_s};
    };
    const EvenlyBetween of_left = evenly(&WheelSample::left_rad), of_right = evenly(&WheelSample::right_rad);
    const InnovationRun as_read = part_of_run(run, hold.from_s, hold.to_s, calibrated.truth.time_offset_s);
    const auto misfit = [&](double share) {
      InnovationRun part = as_read;
      for (WheelSample& w : part.wheels) {
        const double since_s = std::clamp(w.time_s - hold.from_s, 0.0, lasts_s);
        if (hold.left) w.left_rad += share * of_left.gone_rad(since_s);
        if (hold.right) w.right_rad += share * of_right.gone_rad(since_s);
      }
      return misfit_of(part, calibrated);
    };
    const std::optional<ShownShare> shown = shown_share(misfit);
    if (!shown || shown->gain < kShown || shown->best < kLeastOf || shown->best > kMostOf) continue;
    (hold.left && hold.right ? lost.both : hold.left ? lost.left : lost.right).emplace_back(hold.from_s, hold.to_s);
  }
  return lost;
}

}  // namespace odolab
