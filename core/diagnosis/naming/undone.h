// What happens at one moment and is undone soon after is no push: a truth that was somewhere else for a while.
#pragma once

#include <optional>

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

struct Undone {
  int run = 0;
  double from_s = 0.0, to_s = 0.0;        // on the wheels' clock
  double away_m = 0.0, turned_rad = 0.0;  // how far off the truth was meanwhile
};

// Unset where a step that stays says as much.
std::optional<Undone> undone(const JointModel& joint, const ScoredCandidate& at_one_moment);

}  // namespace odolab
