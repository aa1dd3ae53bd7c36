// A marker that is knocked while it is on the way sits elsewhere from then on: at that moment it looks like a push.
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Where the tracked point that sits elsewhere on the vehicle from one moment on says clearly more than the push or bump
// that was named there: its shift turns with the vehicle, as no push does. `evidence`: of what was let in, in its
// order.
std::optional<Unnamed> what_sits_elsewhere_since(const JointModel& joint, const std::vector<ScoredCandidate>& evidence);

}  // namespace odolab
