// How much a name matters: how far it moves the track.
#pragma once

#include <cstddef>
#include <optional>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// How far apart two models of the same recordings dead-reckon. Unset where no recording is a stretch long.
std::optional<MovedTrack> moved_between(const JointModel& without, const JointModel& joint);

// Unset where the effect does not act on the motion, or no recording is a stretch long.
std::optional<MovedTrack> moved_by(const JointModel& joint, std::size_t accepted_effect);

}  // namespace odolab
