// Something that drags on one side turns the vehicle to that side in every metre, forward or in reverse.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class OneSidedDrag final : public Effect {
 public:
  explicit OneSidedDrag(const ActiveEffect& a) : rad_per_m_(a.parameter("rad_per_m")) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    creep.yaw_rate_radps += rad_per_m_ * std::abs(motion.rolled_speed_mps);
  }

 private:
  double rad_per_m_;
};

}  // namespace

std::unique_ptr<Effect> one_sided_drag(const ActiveEffect& active, const Machine&) {
  return std::make_unique<OneSidedDrag>(active);
}

}  // namespace odolab::planar
