// Truth that finds itself elsewhere, time and again: a map that is matched anew, a tracker that takes other beacons.
// That is no physics of the vehicle, and across it nothing is known of the wheels.
#pragma once

#include <utility>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// From one truth sample to the next, as the vehicle would have moved if it had.
struct TruthJump {
  std::pair<double, double> time_s;  // on the truth's clock
  Vec2 at, by;                       // of the axle, in the room
  BodyMotion of_axle;
  double by_chance_m = 0.0;  // one standard error of its sides
};

// Of one recording.
struct TruthJumps {
  std::vector<TruthJump> jumps;
  // How many changes from one sample to the next, against what the wheels say, were looked at, and how far each goes in
  // x and in y (standard deviation, by the middle one).
  double changes = 0.0, change_m = 0.0;
};

// Where one sample lies well off what the wheels say, and all behind it go on from there. None where the truth has no
// headings: the tracked point of a vehicle that was turned jumps as well.
TruthJumps truth_jumps(const InnovationRun& run, const InnovationModel& model);

// Whether they go further than what a truth whose error lasts does all the time now and then: so many of these as large
// are no chance.
bool stand_out(const std::vector<TruthJumps>& recordings);

// Whether all these, of all recordings, are the truth's: six or more; sideways as much as ahead, where nothing rolls,
// so that no wheel did it; not along one line of the vehicle's, as where castors shove it; and not one way at one
// place, as where a camera hands over to another.
bool are_of_the_truth(const std::vector<TruthJump>& jumps);

}  // namespace odolab
