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

// Where the axle's centre is when a predicted track begins, on the encoders' clock: at the first truth sample; without
// any at the origin, and at that time.
TimedPose predicted_start(const Recording& recording, const TruthMounting& mounting, double without_truth_s);

// The axle's track carried to where it passes through a pose, whichever samples that falls between. Before the wheels
// were read, and after, the vehicle is taken to stand.
Track through(Track axle, const TimedPose& start);

// Of the point that the truth measures, on its clock.
Track as_tracked(Track axle, const TruthMounting& mounting);

// A track of which each pose is on some floor; else the error of the recording that led it there.
Result<Track> within_bounds(Track track, const Recording& recording);

}  // namespace odolab
