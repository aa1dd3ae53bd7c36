#include "core/calibration/unknown_heading.h"

#include <algorithm>
#include <cmath>

namespace odolab {

UnknownHeading heading_from_shape(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                                  int first, int last) {
  constexpr double kTimes = 10.0, kLeast_rad = 0.1;
  double cosine = 0.0, sine = 0.0, travelled = 0.0, square_m2 = 0.0;
  int samples = 0;
  Pose pose;
  const Vec2 m = model.truth.axle_T_tracked.position(), start = pose * m;
  for (int t = first; t + 1 < last && !is_cut(run, t + 1); ++t) {
    pose = pose * summed.motions[t].motion;
    travelled += length(summed.motions[t].motion.position());
    if (run.set_aside[t + 1]) continue;
    const Vec2 guess = pose * m - start, truth = run.truth[t + 1].position - run.truth[first].position;
    cosine += dot(guess, truth);
    sine += cross(guess, truth);
    square_m2 += dot(guess, guess);
    ++samples;
    if (travelled > 2.0 && std::hypot(cosine, sine) > 0.5) break;
  }
  UnknownHeading heading{std::atan2(sine, cosine), 1.0};
  if (square_m2 > 0.0)
    heading.stderr_rad =
        std::clamp(kTimes * model.noise.truth_position_m / std::sqrt(square_m2 / samples), kLeast_rad, 1.0);
  return heading;
}

}  // namespace odolab
