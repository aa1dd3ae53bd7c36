#include "core/diagnosis/quality/alike_holds.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/quality/standing_encoder.h"

namespace odolab {

namespace {

constexpr std::size_t kFewestIntervals = 3;

}  // namespace

void KnownHolds::add(const TimeStretches& faults, const std::vector<WheelSample>& wheels, Wheel wheel) {
  for (const HeldReadings& hold : held_readings(wheels, wheel)) {
    if (hold.last < hold.first + kFewestIntervals || hold.last + 1 >= wheels.size()) continue;
    const double from_s = wheels[hold.first].time_s, to_s = wheels[hold.last + 1].time_s;
    const bool is_known = std::any_of(faults.begin(), faults.end(),
                                      [&](const auto& f) { return f.first < from_s + 1e-6 && f.second > to_s - 1e-6; });
    if (!is_known) continue;
    shortest_s = times == 0 ? to_s - from_s : std::min(shortest_s, to_s - from_s);
    longest_s = std::max(longest_s, to_s - from_s);
    ++times;
  }
}

bool KnownHolds::are_alike() const {
  constexpr int kFewest = 3;
  constexpr double kAlike = 1.5;
  return times >= kFewest && longest_s < kAlike * shortest_s;
}

TimeStretches holds_alike(const std::vector<WheelSample>& wheels, Wheel wheel, const KnownHolds& known) {
  constexpr double kCounts = 3.0;  // that one of the steps has: what crawls on coarse counts holds between all of them
  TimeStretches found;
  if (!known.are_alike() || wheels.size() < 3) return found;
  const Wheel other = wheel == Wheel::left ? Wheel::right : Wheel::left;
  const double interval_s = (wheels.back().time_s - wheels.front().time_s) / static_cast<double>(wheels.size() - 1);
  const double least_rad = (kCounts - 0.5) * least_count_rad(wheels, wheel);
  for (const HeldReadings& hold : held_readings(wheels, wheel, 1)) {
    if (hold.last < hold.first + kFewestIntervals || hold.last + 1 >= wheels.size()) continue;
    const double from_s = wheels[hold.first].time_s, to_s = wheels[hold.last + 1].time_s;
    if (to_s - from_s < known.shortest_s - 0.5 * interval_s || to_s - from_s > known.longest_s + 0.5 * interval_s)
      continue;
    const auto step_rad = [&](std::size_t i) {
      return std::abs(rotation(wheels[i], wheel) - rotation(wheels[i - 1], wheel));
    };
    if (std::max(step_rad(hold.first), step_rad(hold.last + 1)) < least_rad) continue;
    bool other_goes_on = true;
    for (std::size_t i = hold.first + 1; i <= hold.last && other_goes_on; ++i)
      other_goes_on = rotation(wheels[i], other) != rotation(wheels[i - 1], other);
    if (other_goes_on) found.emplace_back(from_s, to_s);
  }
  if (found.size() > 2 * static_cast<std::size_t>(known.times)) found.clear();  // known ones are among them
  return found;
}

}  // namespace odolab
