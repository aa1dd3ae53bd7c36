// Bumps and pushes: the moments that say most, each in the form and at the time or place that suits it best.
#pragma once

#include <cstddef>
#include <vector>

#include "core/diagnosis/units/together/joined_candidates.h"

namespace odolab {

// Of the strongest moments beside all that `with` has let in, each as a bump, as one that comes back at its place, and
// as a push, as it suits them; `looked_at` candidates were asked besides. Not what is no more than rounding.
std::vector<ScoredTogether> scored_moments(const JoinedModel& with, std::size_t looked_at);

}  // namespace odolab
