// How well the sizes, times and places of what is found together are known.
#pragma once

#include <Eigen/Core>

#include "core/diagnosis/units/together/joined_candidates.h"

namespace odolab {

// Of amplitudes and free shapes, beside the others that `others` has let in; with what a form is wrong by, and of
// places and limits as wide as what was scanned. `believed_white`: as in JoinedModel::test.
Eigen::MatrixXd joined_covariance(const JoinedModel& others, const ScoredTogether& s, double believed_white);

}  // namespace odolab
