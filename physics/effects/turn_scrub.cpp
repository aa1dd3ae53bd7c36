// In a turn wide wheels and castors scrub: the vehicle turns as if its wheelbase were 1 + k |yaw rate| as wide.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TurnScrub final : public Effect {
 public:
  explicit TurnScrub(const ActiveEffect& a) : per_radps_(a.parameter("per_radps")), by_the_wheels_(form_of(a) == 1) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    const double rate_radps = by_the_wheels_ ? motion.rolled_yaw_rate_radps : motion.yaw_rate_radps;
    const double wider = 1.0 + per_radps_ * std::abs(rate_radps);
    creep.yaw_rate_radps += motion.rolled_yaw_rate_radps * (1.0 / wider - 1.0);
  }

 private:
  double per_radps_;
  bool by_the_wheels_;  // the rate at which they would turn it, and not that at which it does turn
};

}  // namespace

std::unique_ptr<Effect> turn_scrub(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TurnScrub>(active);
}

}  // namespace odolab::planar
