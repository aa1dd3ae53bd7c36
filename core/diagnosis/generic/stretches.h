// What goes on for seconds, once or a few times: a person who leans on the vehicle, a turntable, a tool that pulls, a
// ramp, a tyre that rides on a rim.
#pragma once

#include <optional>

#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Stretches of 2 to 32 s, half of a recording at most, in which the vehicle goes elsewhere than its wheels roll, for
// each metre alike, and further than noise takes it (the tail of `bursts.h`). Noise is fitted to all of a drive, so
// that one stretch of a few seconds may look like noise to whatever is asked of all of it. `explained`, `error`: as of
// bursts.
std::optional<Unnamed> what_goes_on_for_a_while(const JointModel& joint, double explained, double error);

}  // namespace odolab
