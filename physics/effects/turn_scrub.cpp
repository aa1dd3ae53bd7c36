// In a turn wide wheels and castors scrub: the vehicle turns as if its wheelbase were 1 + k |yaw rate| as wide.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TurnScrub final : public Effect {
 public:
  explicit TurnScrub(const ActiveEffect& a) : per_radps_(a.parameter("per_radps")) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    const double wider = 1.0 + per_radps_ * std::abs(motion.yaw_rate_radps);
    creep.yaw_rate_radps += motion.rolled_yaw_rate_radps * (1.0 / wider - 1.0);
  }

 private:
  double per_radps_;
};

}  // namespace

std::unique_ptr<Effect> turn_scrub(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TurnScrub>(active);
}

}  // namespace odolab::planar
