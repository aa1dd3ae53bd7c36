// The axle is not at the wheel's centre: the rolling radius goes up and down once a turn.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class WheelEccentricity final : public Effect {
 public:
  explicit WheelEccentricity(const ActiveEffect& a)
      : component_(a.component), amplitude_(a.parameter("amplitude")), phase_rad_(a.parameter("phase_rad")) {}

  void roll(const VehicleMotion&, RollingWheel& wheel) override {
    if (acts_on(component_, wheel.side)) wheel.radius_m *= 1.0 + amplitude_ * std::sin(wheel.rotation_rad + phase_rad_);
  }

 private:
  std::string component_;
  double amplitude_, phase_rad_;
};

}  // namespace

std::unique_ptr<Effect> wheel_eccentricity(const ActiveEffect& active, const Machine&) {
  return std::make_unique<WheelEccentricity>(active);
}

}  // namespace odolab::planar
