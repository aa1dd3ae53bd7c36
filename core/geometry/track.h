// Poses in time, and how far one track is from another.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

struct TimedPose {
  double time_s = 0.0;
  Pose pose;
};

// In order of time. Headings are unwrapped.
using Track = std::vector<TimedPose>;

// The pose at a time, linear between the neighbours; none outside the track or where it is empty.
std::optional<Pose> pose_at(const Track& track, double time_s);

// Every heading made continuous with the one before it.
void unwrap_headings(Track& track);

// Length of the polygon through the positions.
double travelled_m(const Track& track);

// How far an estimated track is from a reference one.
struct TrackError {
  // Error of the pose gathered over one metre of travel or one turn of a radian, whichever comes first, from a true
  // start: root mean square over all such windows of the reference track, which follow one another.
  double position_rms_m = 0.0;
  double heading_rms_rad = 0.0;
  int windows = 0;
  std::vector<std::pair<double, double>> window_s;  // when they are
  std::vector<Pose> window_error;                   // and the error of each
  // Error at the end of the run and the largest on the way, from a true start.
  double end_position_m = 0.0;
  double end_heading_rad = 0.0;
  double largest_position_m = 0.0;
};

// Compares at the reference's times that both tracks cover. Nothing where they share fewer than two times. `anew`: for
// each of the reference's poses whether the comparison starts again there, since the estimate does not know the way
// from the one before; no window leads across, and the error at the end is that since the last start. Empty: never.
std::optional<TrackError> track_error(const Track& estimate, const Track& reference,
                                      const std::vector<char>& anew = {});

}  // namespace odolab
