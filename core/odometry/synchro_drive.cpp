#include "core/odometry/synchro_drive.h"

#include "core/odometry/synchro_step.h"

namespace odolab {

Track synchro_reckoned(const std::vector<SynchroSample>& samples, const SynchroDrive& drive, const Pose& start,
                       HeadingRule rule) {
  Track track;
  track.reserve(samples.size());
  SynchroPose at{start, start.heading_rad};  // at the start the wheels point along the base
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0)
      at = dead_reckoned(at, samples[i].wheel_rad - samples[i - 1].wheel_rad,
                         samples[i].steering_rad - samples[i - 1].steering_rad, drive, rule);
    track.push_back({samples[i].time_s, at.pose});
  }
  return track;
}

}  // namespace odolab
