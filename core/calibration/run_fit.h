// What one run says on its own of its vehicle and its truth, by plain least squares over stretches of a few decimetres:
// rough, but it has one minimum, knows no start and no other run. What is wrong with a run's data shows in it at once.
#pragma once

#include <optional>

#include "core/geometry/pose.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct RunFit {
  bool drives = false;          // far enough for `way_ratio`; without headings the only number here
  bool turns = false;           // far enough for `turn_ratio`
  double way_ratio = 1.0;       // the truth's way by that of the vehicle file's wheels
  double way_stderr = 0.0;      // of that: on one circle a longer way is a tracked point further out
  double turn_ratio = 1.0;      // the truth's turn by that of the vehicle file's wheels
  double way_explained = 1.0;   // share of the squares of the tracked point's motion that way and turn explain
  double turn_explained = 1.0;  // the same of its turns
  // Where the tracked point sits. Slip in turns, speed lost in turns and a creep of the floor are fitted beside it, as
  // large as they are at most: what they could do as well is in the standard errors.
  Pose axle_T_tracked;
  Pose mounting_stderr;
};

// None where there are no wheels, no truth or too few stretches.
std::optional<RunFit> run_fit(const Recording& recording, const Vehicle& nominal);

}  // namespace odolab
