// Dead reckoning by the unpowered wheels of a trailer, carried over to the vehicle that tows it: UMBmark report,
// section 4.5.
#pragma once

#include <vector>

#include "core/geometry/track.h"
#include "core/odometry/differential_drive.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/encoder_trailer.h"

namespace odolab {

// "Using the same dead-reckoning algorithm as is used for differential-drive robots, one can easily compute the
// incremental position of the center-point of the trailer. Then [...] only a simple coordinate transformation": the
// track of the towing vehicle's centre. Its own wheels are not looked at. The trailer may swivel by any angle.
Track trailer_reckoned(const std::vector<TrailerSample>& samples, const EncoderTrailer& vehicle, const Pose& start,
                       HeadingRule rule = HeadingRule::middle);

// The towing vehicle's pose as seen from the trailer's axle, for a reading of the hitch's encoder.
Pose trailer_T_tow(const EncoderTrailer& vehicle, double hitch_reading_rad);

}  // namespace odolab
