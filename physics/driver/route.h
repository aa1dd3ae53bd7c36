// A path as a row of legs that a robot can drive one after the other.
#pragma once

#include <vector>

#include "core/scenario/scenario.h"

namespace odolab {

struct Leg {
  enum class Kind { line, turn, arc, shift } kind = Kind::line;
  Pose from;                   // where the leg begins, heading along the vehicle
  double length_m = 0.0;       // line, arc, shift: way to go; negative (line): in reverse
  double turn_rad = 0.0;       // turn, arc: left positive
  bool stops = true;           // comes to rest at its end; false: goes on into the next leg
  double direction_rad = 0.0;  // shift: of the way against the heading, which is kept
  Pose end() const;
};

// Squares, straights, figure-eights, waypoints, rectangles and manoeuvres from the start pose; no legs for the other
// kinds of path.
std::vector<Leg> route_of(const Path& path, const Pose& start);

// How long a route takes at the driver's speeds, about.
double duration_of(const std::vector<Leg>& route, const Driving& driving);

}  // namespace odolab
