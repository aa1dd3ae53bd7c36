// A wheel that turns faster rolls on another radius.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class SpeedDependentRadius final : public Effect {
 public:
  explicit SpeedDependentRadius(const ActiveEffect& a) : component_(a.component), per_mps_(a.parameter("per_mps")) {}

  void roll(const VehicleMotion&, RollingWheel& wheel) override {
    if (acts_on(component_, wheel.side))
      wheel.radius_m *= 1.0 + per_mps_ * std::abs(wheel.speed_radps) * wheel.radius_m;
  }

 private:
  std::string component_;
  double per_mps_;
};

}  // namespace

std::unique_ptr<Effect> speed_dependent_radius(const ActiveEffect& active, const Machine&) {
  return std::make_unique<SpeedDependentRadius>(active);
}

}  // namespace odolab::planar
