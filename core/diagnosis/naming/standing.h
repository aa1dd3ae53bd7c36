// What a candidate is worth: whether it stands by itself, and how far its likelihood is to be believed.
#pragma once

#include <vector>

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Of all the evidence, that an effect must have beside those that are let in. Where innovations are correlated a small
// share is believed as little as an event's.
double least_share(const JointModel& joint, const Effect& effect, const CandidateTest& test, double distrust);

// An accepted effect as it stands, held against nothing else.
ScoredCandidate tested_alone(const JointModel& joint, std::size_t accepted);

// What happens in one place or at one moment is judged by how large it seems in all others. While it is left out of the
// model it shows in all that comes behind it, the more so the smaller the noise is: others' scatter is then taken from
// the model that has it.
void judge_locals_by(const std::vector<ScoredCandidate>& with_all, std::vector<ScoredCandidate>& left_out);

// Not by chance, by what it says of runs that it was not fitted to, and by whole counts.
bool stands(const ScoredCandidate& c, double family_wise_error);

// How little the likelihood is to be believed of a candidate: not at all less where it would stand though all scattered
// as much more as correlated innovations let it.
double distrust_of(const JointModel& joint, const ScoredCandidate& c, double family_wise_error);

// A size at the end of what any vehicle has is none: it stands for something else.
bool is_at_its_bound(const AcceptedEffect& a);

}  // namespace odolab
