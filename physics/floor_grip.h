// Many contacts under one body that slide and stick by Coulomb's law, solved together in double precision.
//
// Box2D's friction joint gives each contact the force that would stop it, cut to its grip; the force of a contact that
// slides then leans from the direction of its slip by the body's unequal inertia about it. Two wheels seldom notice.
// Tracks slide with every pad whenever the vehicle turns, and their turn is 9 % wrong so; hence this solve: README,
// Eq. 8.
#pragma once

#include <vector>

#include "physics/planar_world.h"

namespace odolab {

class FloorGrip {
 public:
  // Of a body whose frame is its centre of mass's. The world must outlive this.
  FloorGrip(PlanarWorld& world, int body, double mass_kg, double moment_of_inertia_kgm2, double step_s);

  int add_pad(Vec2 place);  // in the body's frame
  // What the pad's surface does in the next step (as PlanarWorld::set_tread) and the force that it can hold.
  void set_pad(int pad, Vec2 velocity_mps, double grip_n);

  // Gives the body the pads' forces for the world's next step. What else acts on the body (a pin, a slope) is taken to
  // be what acted in the step before.
  void before_step();
  void after_step();

  // Force of the floor on the body in the last step, in the body's frame at its middle.
  Vec2 pad_force_n(int pad) const { return pads_[static_cast<std::size_t>(pad)].force_n; }

 private:
  struct Pad {
    Vec2 place;
    Vec2 velocity_mps;
    double grip_n = 0.0;
    Vec2 force_n;
  };
  struct Motion {
    double x_mps = 0.0, y_mps = 0.0, rate_radps = 0.0;
  };

  Vec2 slip_mps(const Pad& pad, const Motion& m) const {
    return {m.x_mps - m.rate_radps * pad.place.y_m - pad.velocity_mps.x_m,
            m.y_mps + m.rate_radps * pad.place.x_m - pad.velocity_mps.y_m};
  }
  double cost(const Motion& m, const Motion& free, double softness_mps) const;
  Motion newton_step(const Motion& m, const Motion& free, double softness_mps) const;

  PlanarWorld* world_;
  int body_;
  double mass_kg_, inertia_kgm2_, step_s_;
  std::vector<Pad> pads_;
  Vec2 expected_mps_;  // velocity after the step, floor's frame
  double expected_radps_ = 0.0;
  Vec2 other_force_n_;  // floor's frame
  double other_torque_nm_ = 0.0;
};

}  // namespace odolab
