#include "core/diagnosis/units/mended_counts.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/quality/encoder_jumps.h"
#include "core/diagnosis/quality/standing_encoder.h"

namespace odolab {

namespace {

// One wheel's counts among all that was read.
class Counts {
 public:
  Counts(std::vector<UnitSample>& samples, std::size_t unit, Wheel wheel)
      : samples_(samples), unit_(unit), wheel_(wheel) {}

  double rad(std::size_t i) const { return of(samples_[i]); }
  double time_s(std::size_t i) const { return samples_[i].time_s; }
  std::size_t size() const { return samples_.size(); }
  std::size_t at(double time_s) const {
    const auto s = std::lower_bound(samples_.begin(), samples_.end(), time_s - 1e-9,
                                    [](const UnitSample& one, double t) { return one.time_s < t; });
    return static_cast<std::size_t>(s - samples_.begin());
  }

  void go_evenly(std::size_t from, std::size_t to) {
    const double by_rad = rad(to) - rad(from), lasts_s = time_s(to) - time_s(from);
    for (std::size_t i = from + 1; i < to; ++i)
      of(samples_[i]) = rad(from) + (time_s(i) - time_s(from)) / lasts_s * by_rad;
  }
  void shift(std::size_t from, double by_rad) {
    for (std::size_t i = from; i < size(); ++i) of(samples_[i]) += by_rad;
  }
  // From the pace before to that behind.
  void carry_on(std::size_t from, std::size_t to) {
    const auto pace = [&](std::size_t begin, std::size_t end) {
      return end > begin ? (rad(end) - rad(begin)) / std::max(1e-6, time_s(end) - time_s(begin)) : 0.0;
    };
    const std::size_t before = from > 0 ? from - 1 : 0;  // the last interval may be in part of it
    const EvenlyBetween way{pace(before > kReadingsOfPace ? before - kReadingsOfPace : 0, before),
                            pace(to, std::min(to + kReadingsOfPace, size() - 1)), time_s(to) - time_s(from)};
    shift(to, rad(from) + way.gone_rad(way.lasts_s) - rad(to));
    const double from_rad = rad(from), from_s = time_s(from);
    for (std::size_t i = from + 1; i < to; ++i) of(samples_[i]) = from_rad + way.gone_rad(time_s(i) - from_s);
  }

 private:
  double& of(UnitSample& s) const {
    return wheel_ == Wheel::left ? s.wheels[unit_].left_rad : s.wheels[unit_].right_rad;
  }
  const double& of(const UnitSample& s) const {
    return wheel_ == Wheel::left ? s.wheels[unit_].left_rad : s.wheels[unit_].right_rad;
  }

  std::vector<UnitSample>& samples_;
  std::size_t unit_;
  Wheel wheel_;
};

constexpr Wheel kEach[] = {Wheel::left, Wheel::right};

// Whether another wheel of the vehicle turned on meanwhile, nearly as before.
bool another_goes_on(std::vector<UnitSample>& samples, std::size_t unit, Wheel wheel, std::size_t from,
                     std::size_t to) {
  constexpr double kNearly = 0.5;
  const std::size_t span = to - from, earlier = from > span ? from - span : 0;
  for (std::size_t u = 0; u < samples.front().wheels.size(); ++u)
    for (const Wheel w : kEach) {
      if (u == unit && w == wheel) continue;
      const Counts other(samples, u, w);
      const double before_rad = std::abs(other.rad(from) - other.rad(earlier)) / static_cast<double>(from - earlier),
                   now_rad = std::abs(other.rad(to - 1) - other.rad(from)) / static_cast<double>(span - 1);
      if (before_rad > 0.0 && now_rad > kNearly * before_rad) return true;
    }
  return false;
}

// Where a count that jumps had held before, if what it makes good is what another wheel turned meanwhile; else where it
// jumps.
std::size_t held_from(std::vector<UnitSample>& samples, std::size_t unit, Wheel wheel, std::size_t from,
                      std::size_t to) {
  constexpr std::size_t kFewest = 3;
  constexpr double kAlike = 3.0;
  const Counts counts(samples, unit, wheel);
  std::size_t first = from;
  while (first > 0 && counts.rad(first - 1) == counts.rad(from)) --first;
  if (from < first + kFewest) return from;
  const double jump_rad = std::abs(counts.rad(to) - counts.rad(from));
  for (std::size_t u = 0; u < samples.front().wheels.size(); ++u)
    for (const Wheel w : kEach) {
      const Counts other(samples, u, w);
      const double way_rad = std::abs(other.rad(from) - other.rad(first));
      if ((u != unit || w != wheel) && jump_rad < kAlike * way_rad && way_rad < kAlike * jump_rad) return first;
    }
  return from;
}

TimeStretches jumps_of(const Counts& counts, double radius_m, double count_rad) {
  std::vector<double> time_s, rad;
  for (std::size_t i = 0; i < counts.size(); ++i) time_s.push_back(counts.time_s(i)), rad.push_back(counts.rad(i));
  return joined(encoder_jumps(time_s, rad, radius_m, count_rad));
}

// Where a unit swings round from reading to reading, as a castor does whose vehicle reverses, and faster or more slowly
// each time: which way it went between them nobody can tell as well as wheels roll.
TimeStretches swings_of(const std::vector<UnitSample>& samples, std::size_t unit, const DifferentialDrive& drive) {
  constexpr double kUnevenly_rad2 = 0.01;  // turned, times by how much more or less than before or behind
  const auto turned_rad = [&](std::size_t i) {
    const WheelRotation &a = samples[i].wheels[unit], &b = samples[i + 1].wheels[unit];
    return (drive.wheel_radius_right_m * (b.right_rad - a.right_rad) -
            drive.wheel_radius_left_m * (b.left_rad - a.left_rad)) /
           drive.wheelbase_m;
  };
  TimeStretches swings;
  for (std::size_t i = 1; i + 2 < samples.size(); ++i) {
    const double turned = turned_rad(i),
                 more = std::max(std::abs(turned - turned_rad(i - 1)), std::abs(turned_rad(i + 1) - turned));
    if (std::abs(turned) * more > kUnevenly_rad2) swings.emplace_back(samples[i].time_s, samples[i + 1].time_s);
  }
  return swings;
}

}  // namespace

MendedCounts with_mended_counts(std::vector<UnitSample> as_read, const Vehicle& vehicle) {
  constexpr std::size_t kFewest = 4, kRestsOn = 3;  // samples
  const std::vector<VehicleUnit> units = units_of(vehicle);
  MendedCounts mended{std::move(as_read), std::vector<TimeStretches>(units.size())};
  std::vector<UnitSample>& samples = mended.samples;
  if (samples.size() < kFewest) return mended;
  for (std::size_t u = 0; u < units.size(); ++u) {
    TimeStretches& guessed = mended.guessed[u];
    for (const Wheel wheel : kEach) {
      const DifferentialDrive& drive = units[u].drive;
      Counts counts(samples, u, wheel);
      const Counts other(samples, u, wheel == Wheel::left ? Wheel::right : Wheel::left);
      const auto guess = [&](std::size_t from, double to_s) {  // the interval before may be in part of it
        guessed.emplace_back(counts.time_s(from > 0 ? from - 1 : 0), to_s);
      };
      std::vector<WheelSample> wheels = wheels_of(samples, u);
      const TimeStretches moved = moved_at_rest(wheels, wheel), caught_up = catching_up_encoder(wheels, wheel);
      for (const auto& [from_s, to_s] : moved) {
        const std::size_t from = counts.at(from_s), to = counts.at(to_s);
        const bool rests_on = to + kRestsOn < counts.size() && counts.rad(to + kRestsOn) == counts.rad(to);
        if (rests_on && other.rad(to) == other.rad(from))
          counts.shift(to, counts.rad(from) - counts.rad(to));
        else
          counts.go_evenly(from, to);
      }
      for (const auto& [from_s, to_s] : caught_up) {
        counts.go_evenly(counts.at(from_s), counts.at(to_s));
        guess(counts.at(from_s), to_s);
      }
      wheels = wheels_of(samples, u);
      constexpr std::size_t kFewestHeld = 3;  // intervals: of one wheel, a shorter one may be its own
      TimeStretches lost = halting_encoder(wheels, wheel, drive);
      for (const auto& [from_s, to_s] : abrupt_holds(wheels, wheel, drive, kFewestHeld))
        if (another_goes_on(samples, u, wheel, counts.at(from_s), counts.at(to_s))) lost.emplace_back(from_s, to_s);
      for (const auto& [from_s, to_s] : joined(std::move(lost))) {
        counts.carry_on(counts.at(from_s), counts.at(to_s));
        guess(counts.at(from_s), to_s);
      }
      const double radius_m = wheel == Wheel::left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
      for (const auto& [from_s, to_s] : jumps_of(counts, radius_m, least_count_rad(wheels, wheel))) {
        const std::size_t from = counts.at(from_s), to = counts.at(to_s), held = held_from(samples, u, wheel, from, to);
        if (held < from)
          counts.go_evenly(held, to);
        else
          counts.carry_on(from, to);
        guess(held, to_s);
      }
    }
    const TimeStretches swings = swings_of(samples, u, units[u].drive);
    guessed.insert(guessed.end(), swings.begin(), swings.end());
    guessed = joined(std::move(guessed));
  }
  return mended;
}

std::vector<Understood> with_mended_counts(std::vector<Understood> recordings, const Vehicle& vehicle) {
  for (Understood& one : recordings) one.samples = with_mended_counts(std::move(one.samples), vehicle).samples;
  return recordings;
}

}  // namespace odolab
