// Wheels grow or shrink with time, or with the way that they roll: evenly (wear, loss of pressure) or towards an end
// (warming, Newton's law; drying).
#include <cmath>

#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// A run is a session of its own.
class RadiusDrift final : public Effect {
 public:
  RadiusDrift(const ActiveEffect& a, double step_s)
      : component_(a.component),
        step_s_(step_s),
        form_(effects::kDriftForms[form_of(a).value_or(0)]),
        rate_(a.parameter("per_s") / (form_.by_way ? a.parameter("at_mps", 1.0) : 1.0)),
        time_constant_s_(a.parameter("time_constant_s", form_.time_constant_s)) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    if (!form_.by_way) {
      wheel.radius_m *= 1.0 + rate_ * effects::drifted(motion.since_start_s, time_constant_s_);
      return;
    }
    double& rolled_m = rolled_m_[wheel.side == Side::left ? 0 : 1];
    rolled_m += std::abs(wheel.speed_radps) * wheel.radius_m * step_s_;
    wheel.radius_m *= 1.0 + rate_ * effects::drifted(rolled_m, form_.way_constant_m);
  }

 private:
  std::string component_;
  double step_s_;
  effects::DriftForm form_;
  double rate_, time_constant_s_;  // for each second, or for each metre
  double rolled_m_[2] = {};
};

}  // namespace

std::unique_ptr<Effect> radius_drift(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<RadiusDrift>(active, machine.step_s);
}

}  // namespace odolab::planar
