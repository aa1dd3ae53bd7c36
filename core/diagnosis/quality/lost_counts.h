// Where encoders stand still for a while, lose what the wheels turn meanwhile, and the truth knows it.
#pragma once

#include "core/calibration/innovations.h"
#include "core/diagnosis/quality/encoder_jumps.h"

namespace odolab {

// Readings of a wheel, or of both at once, that hold between two paces as no wheel stops and goes on, where the truth
// shows beyond doubt that the vehicle went on: each from the reading that holds to the one that does no more.
JumpsOfWheels lost_counts(const InnovationRun& run, const InnovationModel& calibrated);

}  // namespace odolab
