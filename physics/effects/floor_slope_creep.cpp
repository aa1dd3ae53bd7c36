// Tyres on a slope give way downhill: a steady creep in one direction of the room.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class FloorSlopeCreep final : public Effect {
 public:
  explicit FloorSlopeCreep(const ActiveEffect& a)
      : velocity_mps_(rotated({a.parameter("creep_mps"), 0.0}, a.parameter("direction_rad"))) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    creep.velocity_mps = creep.velocity_mps + rotated(velocity_mps_, -motion.heading_rad);
  }

 private:
  Vec2 velocity_mps_;  // in the floor's frame
};

}  // namespace

std::unique_ptr<Effect> floor_slope_creep(const ActiveEffect& active, const Machine&) {
  return std::make_unique<FloorSlopeCreep>(active);
}

}  // namespace odolab::planar
