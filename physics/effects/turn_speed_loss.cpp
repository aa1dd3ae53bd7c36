// While it turns, the vehicle loses a share of its forward speed in proportion to the turn rate.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TurnSpeedLoss final : public Effect {
 public:
  explicit TurnSpeedLoss(const ActiveEffect& a) : per_radps_(a.parameter("per_radps")) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    creep.velocity_mps.x_m -= per_radps_ * std::abs(motion.rolled_yaw_rate_radps) * motion.rolled_speed_mps;
  }

 private:
  double per_radps_;
};

}  // namespace

std::unique_ptr<Effect> turn_speed_loss(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TurnSpeedLoss>(active);
}

}  // namespace odolab::planar
