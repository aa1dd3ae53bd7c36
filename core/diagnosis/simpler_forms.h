// Of two forms of one effect that say as much, the simpler.
#pragma once

#include "core/diagnosis/naming/select.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// A form that says as much with less is taken where it is not plainly less likely: what warms towards an end begins
// twice as fast as what warms for ever, and the first minutes do not tell them apart; and slip that grows with the
// speed twice, beside a tracked point that was moved, is at two speeds slip that grows with it once.
void take_simpler_forms(JointModel& joint, Selected& selected, const Vehicle& nominal);

}  // namespace odolab
