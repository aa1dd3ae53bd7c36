#include "core/vehicle/differential_drive.h"

#include <cmath>
#include <cstdio>

namespace odolab {

std::vector<std::string> problems_in(const DifferentialDrive& drive) {
  std::vector<std::string> problems;
  const auto demand_above_zero = [&](const char* key, double value, const char* what) {
    if (std::isfinite(value) && value > 0.0) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s: found %g, expected %s above 0", key, value, what);
    problems.emplace_back(text);
  };
  demand_above_zero("wheel_radius_left_m", drive.wheel_radius_left_m, "a length in metres");
  demand_above_zero("wheel_radius_right_m", drive.wheel_radius_right_m, "a length in metres");
  demand_above_zero("wheelbase_m", drive.wheelbase_m, "a length in metres");
  const auto demand_below = [&](const char* key, double value, double limit) {
    if (!(value > limit)) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s: found %g, expected a length in metres below %g", key, value, limit);
    problems.emplace_back(text);
  };
  demand_below("wheel_radius_left_m", drive.wheel_radius_left_m, 10.0);  // no robot's; millimetres, most likely
  demand_below("wheel_radius_right_m", drive.wheel_radius_right_m, 10.0);
  demand_below("wheelbase_m", drive.wheelbase_m, 50.0);
  demand_above_zero("encoder_counts_per_revolution", drive.encoder_counts_per_revolution, "a number of counts");
  demand_above_zero("gear_ratio", drive.gear_ratio, "a ratio");
  if (drive.counter_bits < 0 || drive.counter_bits > 62)
    problems.push_back("counter_bits: found " + std::to_string(drive.counter_bits) +
                       ", expected 0 (never wraps) to 62");
  return problems;
}

}  // namespace odolab
