// A disc on the floor in which wheels lose a share of what they roll: each of them that is on it, or both, or their way
// alone, while the axle's centre is on it.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class SlipZoneOnTheFloor final : public Effect {
 public:
  explicit SlipZoneOnTheFloor(const ActiveEffect& a) : form_(form_of(a).value_or(0)) {
    zone_.shape = Disc{{a.parameter("x_m"), a.parameter("y_m")}, a.parameter("radius_m")};
    zone_.slip = a.parameter("slip");
  }

  void lay_on(Floor& floor) const override {
    if (form_ == kUnderAWheel) floor.slip_zones.push_back(zone_);
  }

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (form_ != kUnderTheMiddle || !contains(zone_.shape, motion.position)) return;
    wheel.slip_mps += zone_.slip * wheel.radius_m * wheel.speed_radps;
  }

  void creep(const VehicleMotion& motion, Creep& creep) override {
    if (form_ != kOfTheWayAlone || !contains(zone_.shape, motion.position)) return;
    creep.velocity_mps.x_m -= zone_.slip * motion.rolled_speed_mps;
  }

 private:
  static constexpr int kUnderAWheel = 0, kUnderTheMiddle = 1, kOfTheWayAlone = 2;
  int form_;
  SlipZone zone_;
};

}  // namespace

std::unique_ptr<Effect> slip_zone(const ActiveEffect& active, const Machine&) {
  return std::make_unique<SlipZoneOnTheFloor>(active);
}

}  // namespace odolab::planar
