// How the evidence of a finding gathers along the recordings: the picture of what lies under the noise everywhere.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// `of_run`: of each recording in time, as JointModel::evidence_of has it; `gain` what all of it comes to, by which it
// is scaled (scores that scatter more than the model says are worth less). Empty where nothing was to be seen.
//
// The fit has its product with what is left zero at the end. So on the way the gain scatters about what is foreseen as
// a Brownian bridge does, with the variance I (1 - I / I_end), I the sum of squares until then.
GatheredEvidence gathered_evidence(const std::vector<std::vector<SampleEvidence>>& of_run,
                                   const std::vector<std::string>& names, double gain);

// Empty also of what is none of the motion, and of what is held where the likelihood itself has it: its score is not
// zero there.
GatheredEvidence gathered_evidence(const JointModel& joint, std::size_t accepted_effect, double gain);

}  // namespace odolab
