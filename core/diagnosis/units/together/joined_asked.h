// What became of every effect that all units were asked for together.
#pragma once

#include <functional>
#include <vector>

#include "core/diagnosis/advice/visible.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/together/joined_candidates.h"

namespace odolab {

struct AskedTogether {
  AskedEffect asked;  // of the part where it is likeliest
  Visible visible;    // of that on which it shows least
};

// `by_itself`, `beside`: candidates as tested without and with what was named. `least`: what one must say, twice the
// gain. What happens at a moment is not among them.
std::vector<AskedTogether> asked_together(const std::vector<ScoredTogether>& by_itself,
                                          const std::vector<ScoredTogether>& beside,
                                          const std::function<double(const Effect&)>& least);

// Puts them in the place of what single units say, whose truth is coarser than what they know of each other.
void put_asked_into(const std::vector<AskedTogether>& all, Diagnosis& diagnosis);

}  // namespace odolab
