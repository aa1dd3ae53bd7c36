// Where an encoder that is known to stand still time and again does so where its wheel goes too slowly to show it.
#pragma once

#include "core/calibration/innovations.h"
#include "core/calibration/left_out.h"
#include "core/diagnosis/effects/effect.h"

namespace odolab {

// How long a wheel's encoder is known to have stood, of all recordings.
struct KnownHolds {
  int times = 0;
  double shortest_s = 0.0, longest_s = 0.0;
  void add(const TimeStretches& faults, const std::vector<WheelSample>& wheels, Wheel wheel);
  // Three, nearly as long as each other: a fault that has a length of its own.
  bool are_alike() const;
};

// Where a wheel's readings hold for as long, between steps that they make before and behind, while the other wheel goes
// on: from the reading that holds to the one that does no more, those that are known among them. Where they hold so
// more than twice as often, it is no fault but what slow wheels do, and none is returned.
TimeStretches holds_alike(const std::vector<WheelSample>& wheels, Wheel wheel, const KnownHolds& known);

}  // namespace odolab
