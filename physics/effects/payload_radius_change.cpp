// A load is put on or taken off at a time: each wheel's radius steps by a fraction.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class PayloadRadiusChange final : public Effect {
 public:
  explicit PayloadRadiusChange(const ActiveEffect& a)
      : left_(a.parameter("left")), right_(a.parameter("right")), at_s_(a.parameter("at_s")) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (motion.time_s >= at_s_) wheel.radius_m *= 1.0 + (wheel.side == Side::left ? left_ : right_);
  }

 private:
  double left_, right_, at_s_;
};

}  // namespace

std::unique_ptr<Effect> payload_radius_change(const ActiveEffect& active, const Machine&) {
  return std::make_unique<PayloadRadiusChange>(active);
}

}  // namespace odolab::planar
