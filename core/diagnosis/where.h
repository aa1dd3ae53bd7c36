// When and where an accepted effect acts.
#pragma once

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Of a push and a bump the moment and the place, with 95 % of what is uncertain of them; of a patch of floor the patch,
// and when the recording that was on it longest was on it. `covariance`: as in Intervals::of_effect.
WhereFound where_of(const JointModel& joint, const AcceptedEffect& accepted, const Eigen::MatrixXd& covariance);

bool overlap(const WhereFound::Zone& one, const WhereFound::Zone& other);

}  // namespace odolab
