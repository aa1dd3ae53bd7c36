// A wheel that turns faster, or of a vehicle that goes faster, rolls on another radius.
#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class SpeedDependentRadius final : public Effect {
 public:
  explicit SpeedDependentRadius(const ActiveEffect& a)
      : component_(a.component),
        form_(effects::kSpeedForms[form_of(a).value_or(0)]),
        amount_(a.parameter("per_mps") / (form_.squared ? a.parameter("at_mps", 1.0) : 1.0)) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    wheel.radius_m *=
        1.0 + amount_ * form_.share(form_.of_the_vehicle ? motion.speed_mps : wheel.speed_radps * wheel.radius_m);
  }

 private:
  std::string component_;
  effects::SpeedForm form_;
  double amount_;  // for each metre per second, or for each square of that
};

}  // namespace

std::unique_ptr<Effect> speed_dependent_radius(const ActiveEffect& active, const Machine&) {
  return std::make_unique<SpeedDependentRadius>(active);
}

}  // namespace odolab::planar
