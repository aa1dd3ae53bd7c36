#include "core/diagnosis/quality/standing_encoder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/quantile.h"

namespace odolab {

namespace {

constexpr std::size_t kPace = 5;  // readings before, and behind, that say how fast a wheel goes

// The truth at a time, by the median of three samples: one of them may err by anything.
class SteadyTruth {
 public:
  explicit SteadyTruth(const std::vector<TruthSample>& samples)
      : samples_(samples),
        has_heading_(samples.front().heading_rad.has_value() && samples.back().heading_rad.has_value()) {
    noise_m_ = noise_of_places_m();
    if (has_heading_) noise_rad_ = noise_of([](const TruthSample& t) { return t.heading_rad.value_or(0.0); });
    period_s_ = (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
  }
  double noise_m() const { return noise_m_; }
  double noise_rad() const { return noise_rad_; }
  double period_s() const { return period_s_; }
  bool has_heading() const { return has_heading_; }

  // Nothing in a gap, of which the next sample says nothing, nor where a heading is missing that others have.
  std::optional<Pose> at(double time_s) const {
    const auto it = std::lower_bound(samples_.begin() + 1, samples_.end() - 2, time_s,
                                     [](const TruthSample& t, double s) { return t.time_s < s; });
    if (std::abs(it->time_s - time_s) >= 2.0 * period_s_) return std::nullopt;
    if (has_heading_ && !((it - 1)->heading_rad && it->heading_rad && (it + 1)->heading_rad)) return std::nullopt;
    const auto middle = [&](auto&& of) { return median({of(*(it - 1)), of(*it), of(*(it + 1))}); };
    return Pose{middle([](const TruthSample& t) { return t.position.x_m; }),
                middle([](const TruthSample& t) { return t.position.y_m; }),
                has_heading_ ? middle([](const TruthSample& t) { return *t.heading_rad; }) : 0.0};
  }

 private:
  template <typename Of>
  double noise_of(const Of& of) const {
    std::vector<double> second;
    for (std::size_t i = 1; i + 1 < samples_.size(); ++i)
      second.push_back(of(samples_[i + 1]) - 2.0 * of(samples_[i]) + of(samples_[i - 1]));
    return scatter_about_zero(std::move(second)) / std::sqrt(6.0);
  }

  // Along the way a pace that changes shows beside it: that of the direction in which it is least, however the room is
  // turned.
  double noise_of_places_m() const {
    constexpr int kDirections = 12;
    double least_m = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kDirections; ++k) {
      const Vec2 towards = rotated({1.0, 0.0}, kPi * k / kDirections);
      least_m = std::min(least_m, noise_of([&](const TruthSample& t) { return dot(towards, t.position); }));
    }
    return least_m;
  }

  const std::vector<TruthSample>& samples_;
  double noise_m_ = 0.0, noise_rad_ = 0.0, period_s_ = 0.0;
  bool has_heading_;
};

}  // namespace

TimeStretches standing_encoder(const std::vector<WheelSample>& wheels, Wheel wheel,
                               const std::vector<TruthSample>& truth, const Vehicle& vehicle) {
  constexpr double kLeast_m = 0.03, kTimesTheNoise = 8.0, kLeast_s = 0.15, kBefore_s = 0.3;
  constexpr double kScale = 0.08;  // error of a length in the file
  // By so much of the wheelbase a tracked point may sit elsewhere than the file says; it moves as a vehicle turns.
  constexpr double kMarkerOff = 0.25;
  constexpr double kFar_rad = 1.0;
  constexpr double kBraked = 0.5, kRunsOn_s = 1.0, kOnItsWay_s = 2.0;
  constexpr double kOfThePaceBefore = 0.4;
  constexpr double kInTheMiddle = 0.25, kAtOnce = 0.7;  // of the whole way, in half of the time; in an eighth of it
  TimeStretches stands;
  if (truth.size() < 4) return stands;
  const DifferentialDrive& drive = std::get<DifferentialDrive>(vehicle.kind);
  const Pose tracked_T_axle = inverse(vehicle.truth.axle_T_tracked);
  const SteadyTruth steady(truth);
  const Wheel other = wheel == Wheel::left ? Wheel::right : Wheel::left;
  const auto rad = [&](std::size_t i) { return rotation(wheels[i], wheel); };
  const auto radius_m = [&](Wheel of) {
    return of == Wheel::left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
  };
  const double base_m = wheel == Wheel::left ? -drive.wheelbase_m : drive.wheelbase_m;
  const double fixed_m = kLeast_m + 2.0 * least_count_rad(wheels, wheel) * radius_m(wheel);
  const double by_place_m = fixed_m + kTimesTheNoise * steady.noise_m(),
               by_turn_m = fixed_m + kTimesTheNoise * drive.wheelbase_m * steady.noise_rad();
  for (const auto& [i, j] : held_readings(wheels, wheel)) {
    const double from_s = wheels[i].time_s, span_s = wheels[j].time_s - from_s;
    const bool both_hold = rotation(wheels[i], other) == rotation(wheels[j], other);
    const auto of_other_m = [&](std::size_t begin, std::size_t end) {
      return radius_m(other) * (rotation(wheels[end], other) - rotation(wheels[begin], other));
    };
    // Of the wheel, from so long before a reading to so long before it.
    const auto pace_before_mps = [&](std::size_t reading, double from_s, double to_s) {
      std::size_t to = reading;
      while (to > 0 && wheels[reading].time_s - wheels[to].time_s < to_s) --to;
      std::size_t from = to;
      while (from > 0 && wheels[reading].time_s - wheels[from].time_s < from_s) --from;
      return radius_m(wheel) * std::abs(rad(to) - rad(from)) / std::max(wheels[to].time_s - wheels[from].time_s, 1e-3);
    };
    const bool turns_far = std::abs(of_other_m(i, j)) > kFar_rad * drive.wheelbase_m;  // a chord is no arc
    const bool by_turn = steady.has_heading() && !both_hold && (turns_far || by_turn_m < by_place_m);
    // The wheel's own way by the truth, and beyond what lengths in the file that are a little wrong make of it. Where
    // headings are known better than places: the other wheel's, and the base times the turn. Else that of the centre,
    // and half the base times the turn; of the centre alone where nothing is known of the turn and both wheels hold.
    const auto way_m = [&](std::size_t begin, std::size_t end) {
      const std::optional<Pose> from = steady.at(wheels[begin].time_s), to = steady.at(wheels[end].time_s);
      if (!from || !to) return 0.0;
      if (!steady.has_heading()) return both_hold ? length(to->position() - from->position()) : 0.0;
      const Pose a = *from * tracked_T_axle, b = *to * tracked_T_axle;
      const double turn = b.heading_rad - a.heading_rad, heading = a.heading_rad + 0.5 * turn;
      const double by_centre_m = dot(b.position() - a.position(), Vec2{std::cos(heading), std::sin(heading)});
      const double across_m = (by_turn ? 1.0 : 0.5) * base_m * turn;
      const double unsure_m =
          kScale * std::abs(across_m) + (by_turn ? 0.0 : kMarkerOff * drive.wheelbase_m * std::abs(turn));
      return std::max(0.0, std::abs((by_turn ? of_other_m(begin, end) : by_centre_m) + across_m) - unsure_m);
    };
    if (j > i + 3 && span_s > std::max(kLeast_s, 1.5 * steady.period_s())) {
      const double all_m = way_m(i, j);
      const double pace_mps = pace_before_mps(i, kBefore_s, 0.0);
      // It came to rest by itself: what the truth still says is a clock that is late, or a marker that rings on.
      const bool was_braked =
          pace_before_mps(i, kBefore_s / 3.0, 0.0) < kBraked * pace_before_mps(i, kBefore_s, kBefore_s * 2.0 / 3.0) &&
          all_m < kRunsOn_s * pace_before_mps(i, kOnItsWay_s, 0.0);
      // It was put down elsewhere: all in one part of the time, and nothing in the others.
      const auto jumps = [&, i = i, j = j] {
        constexpr std::size_t kParts = 8;
        double most_m = 0.0;
        for (std::size_t k = 0; k < kParts; ++k)
          most_m = std::max(most_m, way_m(i + k * (j - i) / kParts, i + (k + 1) * (j - i) / kParts));
        return most_m > kAtOnce * all_m;
      };
      const std::size_t quarter = (j - i) / 4;
      if (!was_braked && all_m > (by_turn ? by_turn_m : by_place_m) && pace_mps > kOfThePaceBefore * all_m / span_s &&
          way_m(i + quarter, j - quarter) > kInTheMiddle * all_m && !jumps())
        stands.push_back({from_s, j + 1 < wheels.size() ? wheels[j + 1].time_s : wheels[j].time_s});
    }
  }
  return stands;
}

TimeStretches catching_up_encoder(const std::vector<WheelSample>& wheels, Wheel wheel) {
  constexpr double kCounts = 5.0, kTimesThePace = 3.0, kGap_s = 0.5;
  constexpr double kOfTheWayMissed = 0.25;  // of what comes at once: a wheel that stood before holds nothing back
  TimeStretches found;
  const double count_rad = least_count_rad(wheels, wheel);
  const auto rad = [&](std::size_t i) { return rotation(wheels[i], wheel); };
  const Wheel other = wheel == Wheel::left ? Wheel::right : Wheel::left;
  // A wheel that sped up before it held, by what it turned last: it goes on so until it is as fast as behind. The other
  // goes on, too.
  const auto is_of_speeding_up = [&](std::size_t i, std::size_t j, double next, double after) {
    constexpr double kOfIt = 0.5, kOfTheOther = 0.25;
    const double last = rad(i) - rad(i - 1), would_turn = 0.5 * (last + after) * static_cast<double>(j + 1 - i);
    return std::abs(last) > kCounts * count_rad && last * after > 0.0 && would_turn / next > kOfIt &&
           would_turn / next < 1.0 / kOfIt &&
           std::abs(rotation(wheels[j + 1], other) - rotation(wheels[i], other)) > kOfTheOther * std::abs(next);
  };
  for (const auto& [i, j] : held_readings(wheels, wheel, kPace))
    if (j >= i + 3 && j + 1 < wheels.size()) {
      const std::size_t end = std::min(j + 1 + kPace, wheels.size() - 1);
      double there_and_back = 0.0;
      for (std::size_t k = j + 1; k < end; ++k) there_and_back += std::abs(rad(k + 1) - rad(k));
      const double before = (rad(i) - rad(i - kPace)) / static_cast<double>(kPace), next = rad(j + 1) - rad(j),
                   intervals_after = std::max(1.0, static_cast<double>(end - j - 1)),
                   after = (rad(end) - rad(j + 1)) / intervals_after;
      if (std::abs(next) > kCounts * count_rad &&
          std::abs(next) > kTimesThePace * std::max(std::abs(before), there_and_back / intervals_after) &&
          (before / next * static_cast<double>(j + 1 - i) > kOfTheWayMissed || is_of_speeding_up(i, j, next, after)) &&
          wheels[j + 1].time_s - wheels[j].time_s < kGap_s)
        found.push_back({wheels[i].time_s, wheels[j + 1].time_s});
    }
  return found;
}

// A wheel's pace over so many intervals, as a straight line of the time, per second or, where stamps are of arrival,
// per interval.
struct Pace {
  double at_s = 0.0, mean = 0.0, slope = 0.0, largest_deviation = 0.0;
  double at(double time_s) const { return mean + slope * (time_s - at_s); }
};

Pace pace_over(const std::vector<WheelSample>& wheels, Wheel wheel, std::size_t begin, std::size_t end, bool per_second,
               bool even) {
  const auto middle_s = [&](std::size_t i) { return 0.5 * (wheels[i].time_s + wheels[i + 1].time_s); };
  const auto pace = [&](std::size_t i) {
    const double by = rotation(wheels[i + 1], wheel) - rotation(wheels[i], wheel);
    return per_second ? by / std::max(1e-6, wheels[i + 1].time_s - wheels[i].time_s) : by;
  };
  Pace p;
  const auto n = static_cast<double>(end - begin);
  for (std::size_t i = begin; i < end; ++i) p.at_s += middle_s(i) / n, p.mean += pace(i) / n;
  double product = 0.0, square = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double from_s = middle_s(i) - p.at_s;
    product += from_s * (pace(i) - p.mean);
    square += from_s * from_s;
  }
  p.slope = even || square <= 0.0 ? 0.0 : product / square;
  for (std::size_t i = begin; i < end; ++i)
    p.largest_deviation = std::max(p.largest_deviation, std::abs(pace(i) - p.at(middle_s(i))));
  return p;
}

namespace {

// On both sides of readings that hold, and what it comes to at their ends. The first and the last interval may be in
// part of the hold.
struct PaceAround {
  Pace before, after;
  double stops, goes_on;
  double slower() const { return std::min(std::abs(stops), std::abs(goes_on)); }
};

// Readings that hold though no motor stops, or speeds up, a wheel and what it drives so suddenly. `even_from`: readings
// from which on the pace is taken to be even; `is_one(hold, pace)`: what else is asked of them.
template <typename IsOne>
TimeStretches sudden_holds(const std::vector<WheelSample>& wheels, Wheel wheel, const DifferentialDrive& drive,
                           std::size_t fewest, std::size_t even_from, const IsOne& is_one) {
  constexpr double kCounts = 4.0;      // that a pace has in each interval
  constexpr double kWheel_mps2 = 3.0;  // more than a motor and what it drives are stopped and sped up by
  const double radius_m = wheel == Wheel::left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
  const double least_rad = kCounts * least_count_rad(wheels, wheel);
  TimeStretches found;
  for (const HeldReadings& hold : held_readings(wheels, wheel, kPace + 1)) {
    const std::size_t first = hold.first, last = hold.last;
    if (last < first + fewest || last + 1 + kPace >= wheels.size()) continue;
    const double interval_s = (wheels[last + 1 + kPace].time_s - wheels[first - kPace].time_s) /
                              static_cast<double>(last + 1 + 2 * kPace - first);
    const bool even = last - first >= even_from;
    for (const bool per_second : {true, false}) {
      const Pace before = pace_over(wheels, wheel, first - 1 - kPace, first - 1, per_second, even),
                 after = pace_over(wheels, wheel, last + 1, last + 1 + kPace, per_second, even);
      const PaceAround pace{before, after, before.at(wheels[first].time_s), after.at(wheels[last].time_s)};
      const double each_rad = pace.slower() * (per_second ? interval_s : 1.0);
      if (pace.stops * pace.goes_on <= 0.0 || each_rad <= least_rad ||
          each_rad * radius_m <= kWheel_mps2 * interval_s * interval_s || !is_one(hold, pace))
        continue;
      found.push_back({wheels[first].time_s, wheels[last + 1].time_s});
      break;
    }
  }
  return found;
}

}  // namespace

TimeStretches halting_encoder(const std::vector<WheelSample>& wheels, Wheel wheel, const DifferentialDrive& drive) {
  constexpr std::size_t kFewest = 2, kEvenFrom = kPace + 1;  // a wheel that speeds up does not go on so for long
  constexpr double kEven = 0.3, kSame = 0.3;                 // of the pace
  const Wheel other = wheel == Wheel::left ? Wheel::right : Wheel::left;
  const auto step_of_other_rad = [&](std::size_t begin, std::size_t end) {
    return std::abs(rotation(wheels[end], other) - rotation(wheels[begin], other)) / static_cast<double>(end - begin);
  };
  return sudden_holds(wheels, wheel, drive, kFewest, kEvenFrom, [&](const HeldReadings& hold, const PaceAround& pace) {
    const double middle_s = 0.5 * (wheels[hold.first].time_s + wheels[hold.last].time_s);
    const double at_middle = pace.before.at(middle_s);
    return std::abs(pace.after.at(middle_s) - at_middle) < kSame * std::abs(at_middle) &&
           std::max(pace.before.largest_deviation, pace.after.largest_deviation) < kEven * pace.slower() &&
           step_of_other_rad(hold.first, hold.last) > (1.0 - kSame) * step_of_other_rad(hold.first - kPace, hold.first);
  });
}

TimeStretches abrupt_holds(const std::vector<WheelSample>& wheels, Wheel wheel, const DifferentialDrive& drive,
                           std::size_t fewest) {
  constexpr std::size_t kNeverEven = static_cast<std::size_t>(-1);
  constexpr double kSteady = 0.5;  // of the pace
  return sudden_holds(wheels, wheel, drive, fewest, kNeverEven, [&](const HeldReadings&, const PaceAround& pace) {
    return pace.before.largest_deviation < kSteady * std::abs(pace.stops) &&
           pace.after.largest_deviation < kSteady * std::abs(pace.goes_on);
  });
}

TimeStretches moved_at_rest(const std::vector<WheelSample>& wheels, Wheel wheel) {
  constexpr std::size_t kRests = 5;  // readings before, and behind
  constexpr double kCounts = 5.0, kShort_s = 0.05;
  const Wheel other = wheel == Wheel::left ? Wheel::right : Wheel::left;
  const double least_rad = kCounts * least_count_rad(wheels, wheel);
  TimeStretches found;
  for (std::size_t i = kRests; i + 1 + kRests < wheels.size(); ++i) {
    if (std::abs(rotation(wheels[i + 1], wheel) - rotation(wheels[i], wheel)) < least_rad ||
        wheels[i + 1].time_s - wheels[i].time_s > kShort_s)
      continue;
    bool rests = true;
    for (std::size_t k = 0; k <= kRests && rests; ++k)
      rests = rotation(wheels[i - k], wheel) == rotation(wheels[i], wheel) &&
              rotation(wheels[i + 1 + k], wheel) == rotation(wheels[i + 1], wheel) &&
              rotation(wheels[i - k], other) == rotation(wheels[i], other) &&
              rotation(wheels[i + 1 + k], other) == rotation(wheels[i], other);
    if (rests) found.push_back({wheels[i].time_s, wheels[i + 1].time_s});
  }
  return found;
}

std::vector<HeldReadings> held_readings(const std::vector<WheelSample>& wheels, Wheel wheel, std::size_t from) {
  std::vector<HeldReadings> holds;
  for (std::size_t i = from; i + 1 < wheels.size();) {
    std::size_t j = i;
    while (j + 1 < wheels.size() && rotation(wheels[j + 1], wheel) == rotation(wheels[i], wheel)) ++j;
    if (j > i) holds.push_back({i, j});
    i = j + 1;
  }
  return holds;
}

double least_count_rad(const std::vector<WheelSample>& wheels, Wheel wheel) {
  double least = 1e9;
  for (std::size_t i = 0; i + 1 < wheels.size(); ++i)
    if (const double by = std::abs(rotation(wheels[i + 1], wheel) - rotation(wheels[i], wheel)); by > 0.0)
      least = std::min(least, by);
  return least;
}

}  // namespace odolab
