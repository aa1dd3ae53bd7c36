// The track that a vehicle file predicts from a recording's encoders or commands alone.
#pragma once

#include "core/base/result.h"
#include "core/geometry/track.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Of the point that the truth measures, stamped on the truth's clock, one pose for each wheel (else command) sample. It
// passes through the first truth sample and looks at no other; without any truth it starts at the origin. A start
// without a heading is taken to look along x.
Result<Track> predicted_track(const Recording& recording, const Vehicle& vehicle);

// A track of which each pose is on some floor; else the error of the recording that led it there.
Result<Track> within_bounds(Track track, const Recording& recording);

}  // namespace odolab
