// The track that a linked or castor vehicle predicts with effects switched on in its units.
#pragma once

#include "core/base/result.h"
#include "core/diagnosis/active_effect.h"
#include "core/geometry/track.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// As predicted_track (core/diagnosis/diagnosis.h): each unit's wheels without what the effects make of them, put into
// the vehicle's own odometry: IPEC, the encoder trailer's, CAST.
Result<Track> predicted_track_of_units(const Recording& recording, const Vehicle& vehicle,
                                       const std::vector<ActiveEffect>& effects);

}  // namespace odolab
