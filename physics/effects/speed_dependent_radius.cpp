// A wheel that turns faster, or of a vehicle that goes faster, rolls on another radius.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class SpeedDependentRadius final : public Effect {
 public:
  explicit SpeedDependentRadius(const ActiveEffect& a)
      : component_(a.component), per_mps_(a.parameter("per_mps")), of_the_vehicle_(form_of(a) == 1) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    if (of_the_vehicle_)
      wheel.radius_m *= 1.0 + per_mps_ * std::abs(motion.speed_mps);
    else
      wheel.radius_m *= 1.0 + per_mps_ * std::abs(wheel.speed_radps) * wheel.radius_m;
  }

 private:
  std::string component_;
  double per_mps_;
  bool of_the_vehicle_;  // its speed, and not the wheel's own
};

}  // namespace

std::unique_ptr<Effect> speed_dependent_radius(const ActiveEffect& active, const Machine&) {
  return std::make_unique<SpeedDependentRadius>(active);
}

}  // namespace odolab::planar
