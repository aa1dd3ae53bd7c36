// Dead reckoning of a synchro drive from the encoders of its two motors.
#pragma once

#include <vector>

#include "core/geometry/track.h"
#include "core/odometry/differential_drive.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/synchro_drive.h"

namespace odolab {

// The track of the base's centre; the heading is the wheels' rolling direction, which turns with the turret.
Track synchro_reckoned(const std::vector<SynchroSample>& samples, const SynchroDrive& drive, const Pose& start,
                       HeadingRule rule = HeadingRule::middle);

}  // namespace odolab
