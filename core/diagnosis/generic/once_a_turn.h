// What a wheel that is uneven does at one place of its turn: a lump, a dent, or a slot of its encoder that is broken,
// which by waves alone seem to come twice or three times a turn.
#pragma once

#include <optional>

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Over which part of its turn, in radians, where most of what the wheel does over it lies within a sixth; else unset.
// By its first eight harmonics, fitted beside a model without names, in each recording with a phase of its own.
// `turns`: by how many turns it comes again for each that is counted, nearly 1.
std::optional<double> part_of_a_turn(const JointModel& without, Wheel wheel, double turns);

// The wheel of a group that goes with a wheel's angle about a whole number of times a turn, and its `turns`.
struct WheelAngle {
  Wheel wheel = Wheel::left;
  double turns = 1.0;
};
std::optional<WheelAngle> angle_of(const GenericTest& group);

}  // namespace odolab
