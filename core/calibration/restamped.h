// The wheels' stamps put elsewhere.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

// As a clock would give them that is right, `rate` being by how much theirs is fast; about the run's first truth
// sample, `offset_s` being how late the truth is.
void put_clock_right(InnovationRun& run, double rate, double offset_s);

// That much later.
void put_later(InnovationRun& run, double delay_s);

}  // namespace odolab
