// How much a name matters: how far it moves the track.
#pragma once

#include <cstddef>
#include <optional>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Unset where the effect does not act on the motion, or no recording is a stretch long.
std::optional<MovedTrack> moved_by(const JointModel& joint, std::size_t accepted_effect);

}  // namespace odolab
