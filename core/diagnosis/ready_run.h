// A checked recording made ready for the joint model.
#pragma once

#include "core/calibration/innovations.h"
#include "core/diagnosis/quality.h"

namespace odolab {

// The run with its faults left out and, where commands stand in for wheels, held as commands are.
Result<InnovationRun> ready_run(const CheckedRecording& checked, const Vehicle& vehicle);

// The wheels' stamps as a clock would give them that is right, `rate` being by how much theirs is fast; about the run's
// first truth sample.
void put_clock_right(InnovationRun& run, double rate, double offset_s);

// The wheels' stamps that much later.
void put_later(InnovationRun& run, double delay_s);

}  // namespace odolab
