#include "core/odometry/differential_drive.h"

namespace odolab {

Track dead_reckoned(const std::vector<WheelSample>& wheels, const DifferentialDrive& drive, const Pose& start,
                    HeadingRule rule) {
  Track track;
  track.reserve(wheels.size());
  Pose pose = start;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (i > 0)
      pose = dead_reckoned(pose, wheels[i].left_rad - wheels[i - 1].left_rad,
                           wheels[i].right_rad - wheels[i - 1].right_rad, drive, rule);
    track.push_back({wheels[i].time_s, pose});
  }
  return track;
}

Track dead_reckoned(const std::vector<CommandSample>& commands, const Pose& start) {
  Track track;
  track.reserve(commands.size());
  Pose pose = start;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (i > 0) {
      const double held_s = commands[i].time_s - commands[i - 1].time_s;
      const double turn_rad = commands[i - 1].yaw_rate_radps * held_s;
      pose = advanced(pose, chord_share(turn_rad) * commands[i - 1].speed_mps * held_s, turn_rad);
    }
    track.push_back({commands[i].time_s, pose});
  }
  return track;
}

}  // namespace odolab
