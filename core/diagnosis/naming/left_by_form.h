// Whether a name may be only what the form of the others, which is never quite the world's, leaves.
#pragma once

#include <vector>

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// `evidence`: of all names, of which the k-th is asked. As much as 0.15 of what the others explain may stay without any
// name beside them (kMostLeft); a name with less must be beyond chance by a millionth of the family-wise error, six
// standard errors. Of the names with less over nine seeds of four programs 10 of 22 wrong ones are not, and none of 6
// right ones.
bool may_be_left_by_form(const std::vector<ScoredCandidate>& evidence, std::size_t k, double family_wise_error);

}  // namespace odolab
