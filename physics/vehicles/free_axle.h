// Two wheels on one axle line of a body that roll freely and only count.
#pragma once

#include <array>
#include <cstdint>

#include "core/vehicle/differential_drive.h"
#include "physics/effects/effects.h"
#include "physics/ground.h"
#include "physics/planar_world.h"
#include "physics/sensors/encoder.h"
#include "physics/vehicles/wheel_state.h"
#include "physics/wheel_pair.h"

namespace odolab {

class Random;

// The axle lies across the body's origin. It holds the body sideways, whatever the force (see PlanarWorld).
class FreeAxle {
 public:
  // `actual` are the true wheels, `counts_per_turn` the encoders'; the number tells its roughness from other axles'.
  // The effects must outlive it; those that change how a wheel rolls or counts act on it.
  FreeAxle(PlanarWorld& world, int body, const DifferentialDrive& actual, double counts_per_turn, int number,
           const planar::Effects& effects, double step_s, Random& phases);

  void before_step();
  void after_step(const Ground& ground);  // a wheel turns by what it travelled, and on a bump by more
  WheelPair read(double time_s) const;
  void set_clock(double begin_s) { begin_s_ = begin_s; }
  const WheelState& left() const { return wheels_[0].state; }
  const WheelState& right() const { return wheels_[1].state; }

 private:
  struct Wheel {
    Side side;
    Vec2 place;
    double radius_m;
    Encoder encoder;
    WheelState state{};
    double travelled_m = 0.0;
  };

  PlanarWorld* world_;
  int body_;
  int number_;
  const planar::Effects* effects_;
  double step_s_;
  double begin_s_ = 0.0;
  std::int64_t steps_ = 0;
  Pose before_;
  std::array<Wheel, 2> wheels_;
};

}  // namespace odolab
