// Whether what is found moves its units by more than counts and the joints' rounding make of nothing.
#pragma once

#include "core/diagnosis/units/together/joined_candidates.h"

namespace odolab {

// Of what happens at a moment.
bool happens_beyond_rounding(const ScoredTogether& s, const Vehicle& vehicle);

// Of what lasts from a time on: by the end of some run.
bool lasts_beyond_rounding(const ScoredTogether& s, const JoinedModel& model);

}  // namespace odolab
