// What a castor's encoders say about the way of its pivot over one sampling interval: "standard odometry equations
// adapted to compensate for the offset of the pivot from the wheel axis" (multi-castor paper, section III.B).
#pragma once

#include <vector>

#include "core/geometry/pose.h"
#include "core/odometry/differential_drive.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/multi_castor.h"

namespace odolab {

// Of one castor, in its own frame at the interval's start.
struct CastorMotion {
  double travel_m = 0.0;     // of the point on the axle beside the pivot
  double turn_rad = 0.0;     // of the castor against the floor, by its wheels
  double swivel_rad = 0.0;   // of the castor against the body, by its pivot encoder, modulo a turn
  double heading_rad = 0.0;  // of the castor against the body at the start, by its pivot encoder
};
CastorMotion castor_motion(const Castor& castor, const CastorReading& before, const CastorReading& now);

// The way of the pivot over the floor, the body's heading at the start being `body_heading_rad`: the (Delta x_i, Delta
// y_i) of Eq. 13 and 14. `rule` is for the axle's travel.
Vec2 pivot_way(const Castor& castor, const CastorMotion& motion, double body_heading_rad, HeadingRule rule);

}  // namespace odolab
