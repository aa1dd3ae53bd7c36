// Wheels grow or shrink with time: evenly (wear, loss of pressure) or towards an end (warming, Newton's law).
#include <cmath>

#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// A run is a session of its own.
double time_constant_in_form_s(const ActiveEffect& a) {
  return effects::kDriftForms[form_of(a).value_or(0)].time_constant_s;
}

class RadiusDrift final : public Effect {
 public:
  explicit RadiusDrift(const ActiveEffect& a)
      : component_(a.component),
        per_s_(a.parameter("per_s")),
        time_constant_s_(a.parameter("time_constant_s", time_constant_in_form_s(a))) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    const double t = motion.since_start_s, end_s = time_constant_s_;
    wheel.radius_m *= 1.0 + per_s_ * (end_s > 0.0 ? end_s * -std::expm1(-t / end_s) : t);
  }

 private:
  std::string component_;
  double per_s_, time_constant_s_;
};

}  // namespace

std::unique_ptr<Effect> radius_drift(const ActiveEffect& active, const Machine&) {
  return std::make_unique<RadiusDrift>(active);
}

}  // namespace odolab::planar
