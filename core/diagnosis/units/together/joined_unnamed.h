// Whether something is left that has no name, of all units together. README.md in the folder above, "Together".
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/together/joined_candidates.h"

namespace odolab {

// Beside what was named, or instead of it: the strongest group; or the pushes, where there are several.
std::optional<Finding> unnamed_together(const JoinedModel& model, const std::vector<ScoredTogether>& named,
                                        double family_wise_error);

// The encoder of a joint that errs otherwise than by a bias.
std::optional<Finding> unnamed_joint(const JoinedModel& model, double family_wise_error);

}  // namespace odolab
