// What is otherwise with the truth from one moment on, and looks like a push there: a marker that is knocked, a clock
// that is set.
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Where that says clearly more than the push or bump that was named there: what a marker sits off turns with the
// vehicle, what a clock is off grows with its speed, as no push does. `evidence`: of what was let in, in its order.
std::optional<Unnamed> what_is_otherwise_since(const JointModel& joint, const std::vector<ScoredCandidate>& evidence);

}  // namespace odolab
