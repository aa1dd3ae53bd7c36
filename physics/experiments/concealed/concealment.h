// Whether a case is concealed, measured; and the errors that this and the held-out figures are made of.
#pragma once

#include "core/diagnosis/fitted_model.h"
#include "physics/experiments/concealed/judged.h"

namespace odolab::concealed {

// Mean squared error gathered over a metre or a radian, of the points where the wheels touch the floor: position error
// squared plus the square of the heading error times half the wheelbase.
struct SquaredError {
  double sum_m2 = 0.0;
  int windows = 0;
  void add(const Track& estimate, const Track& reference, double arm_m);
  double mean() const { return windows > 0 ? sum_m2 / windows : 0.0; }
};

// The tracked point as it really moved, every hundredth of a second.
Track true_tracked(const Run& run);

// `calibrated`: what calibration without any effect makes of the given runs.
Concealment concealment(const DrawnCase& drawn, const FittedModel& calibrated);

}  // namespace odolab::concealed
