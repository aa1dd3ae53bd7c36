#include "core/diagnosis/quality/unmeasured_heading.h"

#include <algorithm>

#include "core/base/formatted.h"

namespace odolab {

std::optional<std::string> unmeasured_heading(const std::vector<TruthSample>& truth,
                                              const std::vector<WheelSample>& wheels, const DifferentialDrive& drive) {
  constexpr double kTurned_rad = 1.0;
  if (truth.size() < 2 || wheels.empty() || !truth.front().heading_rad) return std::nullopt;
  for (const TruthSample& t : truth)
    if (t.heading_rad && *t.heading_rad != *truth.front().heading_rad) return std::nullopt;
  double least_rad = 0.0, most_rad = 0.0;
  for (const WheelSample& w : wheels) {
    if (w.time_s < truth.front().time_s || w.time_s > truth.back().time_s) continue;
    const double turned_rad = (drive.wheel_radius_right_m * (w.right_rad - wheels.front().right_rad) -
                               drive.wheel_radius_left_m * (w.left_rad - wheels.front().left_rad)) /
                              drive.wheelbase_m;
    least_rad = std::min(least_rad, turned_rad);
    most_rad = std::max(most_rad, turned_rad);
  }
  if (most_rad - least_rad < kTurned_rad) return std::nullopt;
  return formatted(
      "truth_heading_rad is %.9g throughout while the wheels turn the vehicle by %.3g rad: taken as not "
      "measured",
      *truth.front().heading_rad, most_rad - least_rad);
}

}  // namespace odolab
