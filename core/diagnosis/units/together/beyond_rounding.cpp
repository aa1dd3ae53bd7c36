#include "core/diagnosis/units/together/beyond_rounding.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect_motions.h"

namespace odolab {

namespace {

double rounding_m(const ScoredTogether& s, const Vehicle& vehicle) {
  constexpr double kCounts = 1.5;
  double least_m = 0.0;
  const std::vector<VehicleUnit> units = units_of(vehicle);
  for (std::size_t u : s.candidate.units) {
    const DifferentialDrive& d = units[u].drive;
    least_m = std::max({least_m, kCounts * 2.0 * kPi * d.wheel_radius_left_m / d.counts_per_wheel_turn(),
                        rounding_of_joints(vehicle, u).position_m});
  }
  return least_m;
}

}  // namespace

bool happens_beyond_rounding(const ScoredTogether& s, const Vehicle& vehicle) {
  const double least_m = rounding_m(s, vehicle);
  if (s.test.value.size() < 3) return std::abs(s.test.value[0]) > least_m;
  const double base_m = units_of(vehicle)[s.candidate.units.front()].drive.wheelbase_m;
  return std::max(std::hypot(s.test.value[0], s.test.value[1]), 0.5 * base_m * std::abs(s.test.value[2])) > least_m;
}

bool lasts_beyond_rounding(const ScoredTogether& s, const JoinedModel& model) {
  const double least_m = rounding_m(s, model.vehicle());
  const std::vector<double> value(s.test.value.begin(), s.test.value.end());
  for (std::size_t u : s.candidate.units)
    for (const DriveView& view : model.views(u)) {
      const Motions moved = motion_of(*s.candidate.effect, view, s.shape, value);
      double forward_m = 0.0, turn_rad = 0.0;
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        forward_m += moved.at(i).forward_m;
        turn_rad += moved.at(i).turn_rad;
        if (std::max(std::abs(forward_m), 0.5 * view.drive.wheelbase_m * std::abs(turn_rad)) > least_m) return true;
      }
    }
  return false;
}

}  // namespace odolab
