#include "core/diagnosis/moved_track.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/track.h"

namespace odolab {

std::optional<MovedTrack> moved_between(const JointModel& without, const JointModel& joint) {
  std::vector<Pose> moved;  // of each stretch
  for (int r = 0; r < static_cast<int>(joint.runs().size()); ++r)
    if (const std::optional<TrackError> e = track_error(without.dead_reckoned(r), joint.dead_reckoned(r)))
      moved.insert(moved.end(), e->window_error.begin(), e->window_error.end());
  // A heading moves the next metre by as much as that is long.
  const auto size_m = [](const Pose& p) { return std::hypot(length(p.position()), 1.0 * p.heading_rad); };
  double most_m = 0.0;
  for (const Pose& p : moved) most_m = std::max(most_m, size_m(p));
  constexpr double kActs = 0.1;
  double sum_m2 = 0.0, sum_rad2 = 0.0;
  int stretches = 0;
  for (const Pose& p : moved) {
    if (size_m(p) < kActs * most_m) continue;
    sum_m2 += dot(p.position(), p.position());
    sum_rad2 += p.heading_rad * p.heading_rad;
    ++stretches;
  }
  if (stretches == 0) return std::nullopt;
  return MovedTrack{std::sqrt(sum_m2 / stretches), std::sqrt(sum_rad2 / stretches)};
}

std::optional<MovedTrack> moved_by(const JointModel& joint, std::size_t accepted_effect) {
  if (!joint.accepted[accepted_effect].acts_on_motion()) return std::nullopt;
  JointModel without = joint;
  joint.lost_without(static_cast<int>(accepted_effect), &without);
  return moved_between(without, joint);
}

}  // namespace odolab
