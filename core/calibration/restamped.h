// The wheels' stamps put elsewhere.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

// As a clock would give them that is right, `rate` being by how much theirs is fast; about the run's first truth
// sample, `offset_s` being how late the truth is.
void put_clock_right(InnovationRun& run, double rate, double offset_s);

// Two clocks: the truth's, late by `offset_s` at its first sample, and that of the wheels, which is fast by `rate`.
struct TwoClocks {
  double first_sample_s = 0.0;  // the truth's stamp
  double offset_s = 0.0, rate = 0.0;
  // What one shows where the other shows that.
  double wheels_stamp_s(double truth_stamp_s) const;
  double truth_stamp_s(double wheels_stamp_s) const;
};

// That much later.
void put_later(InnovationRun& run, double delay_s);

}  // namespace odolab
