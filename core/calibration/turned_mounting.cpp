#include "core/calibration/turned_mounting.h"

#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/calibration/run_fit.h"
#include "core/geometry/angles.h"

namespace odolab {

Vehicle turned_as_driven(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  constexpr double kFar_rad = 1.0, kAlike_rad = 0.2, kExplained = 0.9;
  if (!std::holds_alternative<DifferentialDrive>(nominal.kind)) return nominal;
  std::vector<std::optional<RunFit>> fits(recordings.size());
  parallel_for(static_cast<int>(fits.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    if (problems_in(recordings[r]).empty()) fits[r] = run_fit(recordings[r], nominal);
  });
  std::optional<double> turned_rad;
  for (const std::optional<RunFit>& fit : fits) {
    if (!fit || !fit->drives || !fit->turns || fit->way_explained < kExplained || fit->turn_explained < kExplained ||
        fit->turn_ratio <= 0.0)
      continue;
    const double own_rad = fit->axle_T_tracked.heading_rad;
    if (turned_rad && std::abs(wrapped(own_rad - *turned_rad)) > kAlike_rad) return nominal;
    if (!turned_rad) turned_rad = own_rad;
  }
  Vehicle turned = nominal;
  double& heading_rad = turned.truth.axle_T_tracked.heading_rad;
  if (turned_rad && std::abs(wrapped(*turned_rad - heading_rad)) > kFar_rad) heading_rad = wrapped(*turned_rad);
  return turned;
}

}  // namespace odolab
