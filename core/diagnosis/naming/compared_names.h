// Which of two names for the same evidence is the better one.
#pragma once

#include <vector>

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Share of the evidence that a right name may lose since its form is not quite the world's.
constexpr double kFormError = 0.15;

// What was looked for in more places and at more times than another must say so much more, in twice the log-likelihood.
double more_by_tries(const ScoredCandidate& c, const ScoredCandidate& other);

// Whether it says clearly more, by their own scatters and by one: that of others while a name is missing has nothing to
// do with which of two is right.
bool beats(const ScoredCandidate& c, const ScoredCandidate& other);

// A push of three numbers fits whatever a bump of one does, and its form is exact: where one number says nearly as much
// it is the better name. So it is beside a patch, whose place and size were looked for in three directions.
bool is_simpler(const ScoredCandidate& c, const ScoredCandidate& other);

// Whether a candidate in a name's place says beside the name, among all that was asked `with_all` that was let in, as
// much: then it is something else, and no other name for it.
bool says_as_much_beside(const ScoredCandidate& instead, const std::vector<ScoredCandidate>& with_all);

}  // namespace odolab
