// A recording driven through the planar vehicle: the simulated track beside the recorded truth.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/track.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "physics/vehicles/vehicle_shape.h"

namespace odolab {

struct TimedPosture {
  double time_s = 0.0;
  VehiclePosture posture;
};

// What a replay shows. All tracks are those of the point that the truth measures, on the truth's clock.
struct Replay {
  Track truth;
  Track simulated;                     // the planar vehicle, driven by the recorded wheel rotation or commands
  Track dead_reckoned;                 // the vehicle file's odometry from the same start, without any physics
  VehicleShape shape;                  // of the planar vehicle
  std::vector<TimedPosture> postures;  // its parts about the point that the truth measures, where asked for
  // A truth without headings lends its first metres to find the heading of the start; its headings here are those of
  // dead reckoning, and only the position at the end and the largest on the way can be judged.
  bool truth_has_headings = true;
  // Against the truth; none where it has fewer than two samples.
  std::optional<TrackError> simulated_error;
  std::optional<TrackError> dead_reckoned_error;
};

// A scenario that replays with a vehicle just as its file says, on a plain floor.
Scenario replay_scenario(const Vehicle& vehicle, const Recording& recording);

// Runs the scenario, whose path is a ReplayPath. Any kind of vehicle is turned by its own wheels as they were recorded,
// or follows the recorded commands. An error where the recording holds nothing to drive by. Above 0, `picture_period_s`
// asks for a posture as often.
Result<Replay> replay(const Scenario& scenario, std::shared_ptr<const Recording> recording,
                      const Progress& progress = {}, double picture_period_s = 0.0);

}  // namespace odolab
