// What a term says once the noise is what it leaves.
#pragma once

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// What a model does not describe looks like noise to it: the sizes of the noise are fitted to what is left, and grow
// with it. Under them the score of the very term that is missing is small, the more so the poorer the truth is: of
// thirty standard errors under the true noise five and a half were left. So the noise is fitted with the term in the
// model.
//
// Where there are no more innovations than that, they do not tell their noise from what one name takes away: the poses
// at both ends of ten runs leave a name a noise so small that anything is beyond chance.
constexpr double kFewestToTellNoise = 100.0;

// `with`: a model with that term let in last and fitted; the noise is fitted here.
CandidateTest scored_under_own_noise(JointModel& with, bool thorough, const AskedHow& how = {});
// The same, the statistic no larger than what the likelihood gains from the model `without` to that `with` the term:
// where nothing is missing the score alone is too large, by what the noise loses to terms of many columns.
CandidateTest tested_under_own_noise(const JointModel& without, JointModel& with, bool thorough,
                                     const AskedHow& how = {});

}  // namespace odolab
