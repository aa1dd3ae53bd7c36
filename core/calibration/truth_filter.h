// Filters through which trackers, radios and satellite receivers hand on what they measured.
#pragma once

#include "core/recording/recording.h"

namespace odolab {

struct TruthFilter {
  enum class Kind {
    low_pass,          // each sample is the one before, moved by a share of what was measured from it
    low_pass_twice,    // the same of what comes out of that
    constant_velocity  // the same of the one before carried on by a speed, which learns too: Kalman's filter, gone
                       // still
  };
  Kind kind = Kind::low_pass;
  double time_constant_s = 0.0;  // T: of the way to what was measured 1 - exp(-dt / T) is gone in dt

  // By how much it is late in the mean: a way at a steady speed comes out so much later.
  double late_s() const {
    return kind == Kind::low_pass ? time_constant_s : kind == Kind::low_pass_twice ? 2.0 * time_constant_s : 0.0;
  }
};

// What had been measured: the filter solved for its input. Stamps grow by what the filter is late, so that the truth's
// clock stays as late as it seems, and a pose that is predicted by it is where the recording has it. The first sample,
// whose past is not known, is left out.
Recording unfiltered_truth(const Recording& recording, const TruthFilter& filter);

// By how much what was measured is spread wider than the samples as recorded, as a factor, dt_s after the one before.
double spread_of_measured(const TruthFilter& filter, double dt_s);

}  // namespace odolab
