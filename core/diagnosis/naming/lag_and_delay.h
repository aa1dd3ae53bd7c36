// A lag and a clock's offset, which feign each other.
#pragma once

#include <optional>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// By how much twice the log-likelihood is larger than another's. With another clock a run may begin with one sample of
// the truth more or less, which counts as all others do.
double likelier_by(const JointModel& a, const JointModel& than);

// Puts the lag that was let in to the size at which the likelihood is largest, all else fitted anew, and holds it
// there. The offset that would do nearly as well changes with the lag along a valley that is bent: steps along the
// columns run out of it, to and fro. What was noise of the moment at which commands are acted on may have been the
// lag: it is put there as if they were acted on evenly, too, and the noise fitted to both.
void put_lag_where_likeliest(JointModel& joint);

// The same, where others were let in after it: what they do was the lag's in part.
void put_lag_anew(JointModel& joint);

// Behind commands: a base that lags is first taken for one that is late, and what is left looks like anything. Where a
// lag in the place of the clocks' delay, or of half of it, is the likelier beyond doubt, noise and all, it is let in.
// The model must have been linearised.
void let_lag_in(JointModel& joint);

// Whether a lag as long as a delay that was found, or half as long beside a clock's offset, describes the recordings
// too: then it stays beside it.
std::optional<Alternative> lag_instead(const JointModel& joint, double delay_s, double gain_of_delay);

// The variance of an accepted effect's size that is held so, by how the likelihood bends along the valley: its column
// says nothing of that. In its own unit, squared.
double variance_of_held(const JointModel& joint, std::size_t accepted);

}  // namespace odolab
