// Tyres on a slope give way downhill: a steady creep in one direction of the room.
#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class FloorSlopeCreep final : public Effect {
 public:
  explicit FloorSlopeCreep(const ActiveEffect& a)
      : velocity_mps_(rotated({a.parameter("creep_mps"), 0.0}, a.parameter("direction_rad"))),
        turning_alone_(form_of(a) == 1) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (wheel.speed_radps != 0.0) turned_at_s_ = motion.since_start_s;
  }

  void creep(const VehicleMotion& motion, Creep& creep) override {
    if (turning_alone_ && !(motion.since_start_s <= turned_at_s_ + effects::kTurningWithin_s)) return;
    creep.velocity_mps = creep.velocity_mps + rotated(velocity_mps_, -motion.heading_rad);
  }

 private:
  Vec2 velocity_mps_;  // in the floor's frame
  bool turning_alone_;
  double turned_at_s_ = -1.0;  // a wheel, last
};

}  // namespace

std::unique_ptr<Effect> floor_slope_creep(const ActiveEffect& active, const Machine&) {
  return std::make_unique<FloorSlopeCreep>(active);
}

}  // namespace odolab::planar
