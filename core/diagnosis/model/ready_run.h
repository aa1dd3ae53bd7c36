// A checked recording made ready for the joint model.
#pragma once

#include "core/calibration/innovations.h"
#include "core/diagnosis/quality.h"

namespace odolab {

// The run with its faults left out and, where commands stand in for wheels, held as commands are.
Result<InnovationRun> ready_run(const CheckedRecording& checked, const Vehicle& vehicle);

}  // namespace odolab
