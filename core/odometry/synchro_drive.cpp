#include "core/odometry/synchro_drive.h"

namespace odolab {

Track synchro_reckoned(const std::vector<SynchroSample>& samples, const SynchroDrive& drive, const Pose& start,
                       HeadingRule rule) {
  Track track;
  track.reserve(samples.size());
  Pose pose = start;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) {
      const double steered_rad = (samples[i].steering_rad - samples[i - 1].steering_rad) / drive.steering_ratio;
      const double rolled_rad = samples[i].wheel_rad - samples[i - 1].wheel_rad;
      const double travel_m = drive.wheel_radius_m * (rolled_rad - drive.wheel_rad_per_steering_rad * steered_rad);
      const double base_turn_rad =
          drive.base_turn_rad_per_m * travel_m + drive.base_turn_rad_per_steering_rad * steered_rad;
      const double turn_rad = steered_rad + base_turn_rad;
      const double direction_rad = pose.heading_rad + (rule == HeadingRule::middle ? 0.5 : 1.0) * turn_rad;
      pose = {pose.x_m + travel_m * std::cos(direction_rad), pose.y_m + travel_m * std::sin(direction_rad),
              pose.heading_rad + turn_rad};
    }
    track.push_back({samples[i].time_s, pose});
  }
  return track;
}

}  // namespace odolab
