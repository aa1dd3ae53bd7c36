#include "core/diagnosis/units/together/usual.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

double fastest_mps(const JoinedModel& model) {
  double most_mps = 0.0;
  for (const DriveView& view : model.views(0))
    for (const EffectStep& step : view.steps) most_mps = std::max(most_mps, std::abs(step.speed_mps));
  return most_mps;
}

}  // namespace

bool is_usual(const ScoredTogether& s, const JoinedModel& model) {
  constexpr double kAngle_rad_per_mps2 = 0.016, kShare_per_mps2 = 0.01, kRunOut = 5e-4;
  const Effect& e = *s.candidate.effect;
  if (e.name == "traction_slip") return std::abs(s.test.value[0]) < kShare_per_mps2;
  if (e.name == "wheel_eccentricity") {
    const double runs = 0.5 * static_cast<double>(s.test.value.size());
    return s.test.value.norm() / std::sqrt(runs) < kRunOut;
  }
  if (e.name != "lateral_slip") return false;
  const bool grows_with_speed = e.stated_at_mps && e.stated_at_mps(s.shape, model.views(0)) > 0.0;
  return std::abs(s.test.value[0]) < kAngle_rad_per_mps2 * (grows_with_speed ? 1.0 : fastest_mps(model));
}

}  // namespace odolab
