// Whether radii that would step, or drift in several ways, go by one law that no name has.
#pragma once

#include <optional>

#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Where a load was named, or more than one drift of a radius: tyres that dry, shed dust or lose air are nearly a drift,
// and what is left of them nearly a load. Hats of each wheel's radius over the way, or the time, since the start, or
// what of it fades over seconds, must be likelier than all these names by twice as many as they are, under the noise of
// either. Of 18 loads that were there none came near (8 of 28 at most), of seven that were something of the kind six
// did (44 to 230).
std::optional<Unnamed> what_radii_go_by_instead(const JointModel& joint);

}  // namespace odolab
