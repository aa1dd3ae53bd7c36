// An effect that is asked for by name, whether it was found or not: what a fit with it predicts better than one
// without.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/fitted_model.h"
#include "core/recording/recording.h"

namespace odolab {

// Error gathered over short windows that overlap by three quarters: root mean square without the largest tenth, which
// pushes make.
struct WindowError {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

struct LookedFor {
  double size = 0.0;  // as fitted: of both wheels the root mean square of amplitudes; per m/s; m/s
  int runs = 0;       // that were judged
  WindowError without, with;
  double better_by = 0.0;  // by how many of its own standard errors the windows' squared error is smaller with it
};

// Fits wheel radii, wheelbase and mounting anew to the first half of each run, once without and once with the effect
// (wheel_eccentricity: both wheels, in each run by itself; speed_dependent_radius;
// floor_slope_creep), and judges the second halves. What else the model holds stays in as it is. Windows are of a metre
// or a radian, for eccentricity of half a turn of a wheel. Nothing where no run can show it.
std::optional<LookedFor> looked_for(const std::string& effect, const FittedModel& model,
                                    const std::vector<Recording>& runs);

}  // namespace odolab
