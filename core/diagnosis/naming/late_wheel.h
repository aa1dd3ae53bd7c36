// One wheel's counts that are a little older than the other's, as a loop reads them that asks one counter after the
// other: wherever the vehicle speeds up the older ones fall behind, as if the other wheel slipped.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

inline constexpr double kLoopTakes_s = 0.002;  // from one counter to the other, at most

// What counts of the right wheel that are older by one second leave out.
Motions of_older_counts(const DriveView& view);

// By how much older the right wheel's counts are than the left one's, in seconds, negative if newer: where that is no
// more than loops take and says as much as the k-th name that was let in, which acts on one wheel where it speeds up,
// slows or turns round. `evidence`: that of the name.
std::optional<double> older_instead(const JointModel& joint, std::size_t k, const ScoredCandidate& evidence);

// How much older the right wheel's counts are, 0 where that was taken for no name, and the names that say no more.
struct OlderCounts {
  double right_older_s = 0.0;
  std::vector<std::string> instead_of;
};
std::string in_words(const OlderCounts& older);

}  // namespace odolab
