// Self-calibration of two linked trucks from what their own encoders contradict: the corrections that IPEC makes on a
// smooth floor are, on average, errors of its parameters (CLAPPER paper, sections 5.1 and 5.2).
//
// Over each stretch the wheels predict how the link's angles and length change; what the link's encoders read instead
// is explained by unequal wheels and wheelbases of both trucks (conventional errors), and by biased rotary and linear
// encoders (unconventional ones). Least squares with weak priors about the vehicle file; stretches over bumps count
// less.
#pragma once

#include <vector>

#include "core/calibration/internal.h"

namespace odolab {

struct LinkedCalibrationOptions {
  double stretch_m = 0.25;      // windows of so much travel of either truck, or
  double stretch_rad = 0.25;    // turn
  bool fit_link_angles = true;  // the rotary encoders' offsets; else those of the vehicle file hold
  bool fit_link_length = true;
};

// Clapper or OmniMate. The scale, which is that of truck A's mean wheel radius, is taken as known: no internal encoder
// measures distances on the floor. What the recordings cannot tell keeps its value and is said. Where the rotary
// encoders' biases cannot be told from unequal wheels (driving straight or turning gently with both trucks in line
// curves by either), they are taken as in the vehicle file, which is the paper's self-calibration of the trucks.
Result<InternalCalibration> calibrate_linked(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                             const Progress& progress = {},
                                             const LinkedCalibrationOptions& options = {});

}  // namespace odolab
