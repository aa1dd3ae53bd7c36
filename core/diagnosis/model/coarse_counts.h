// What whole counts hide where they are the largest error of all.
#pragma once

#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Of the recording that is read most coarsely, and at the rim of the larger wheel. Zero where readings are not rounded.
double largest_count_rad(const JointModel& joint);
double largest_count_m(const JointModel& joint);

// Whether the rounding of the wheels' counts errs by more than twice what a sample of the truth does, in place or
// heading, and wheels turn by fewer than eight from reading to reading: nothing tells then where between two counts a
// wheel is, and counts come and go with what the driver does.
bool counts_are_coarse(const JointModel& joint);

// The same by more than half of that, and by fewer than sixteen: what they feign is asked of the same drives, counted
// again (driven_again.h).
bool counts_may_feign(const JointModel& joint);

// Whether a term with such amplitudes displaces a rim by less than 0.6 counts for nine tenths of the time, 1.5 where
// counts are coarse, against where it would be without; or, where they are, by less than what rounded readings that
// stand for derivatives too take away of everything that goes with them.
bool is_within_counts(const JointModel& joint, const Effect& term, const std::vector<double>& value,
                      const std::vector<double>& shape);

}  // namespace odolab
