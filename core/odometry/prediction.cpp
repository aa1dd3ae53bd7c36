#include "core/odometry/prediction.h"

#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

// The track carried to where it passes through a pose at a time, whichever samples that falls between.
Track through(const Track& track, double start_s, const Pose& start) {
  const std::optional<Pose> there = pose_at(track, start_s);
  if (!there) {  // the truth begins before the wheels were read, or after: then the vehicle is taken to stand until
                 // then
    if (track.empty() || start_s > track.back().time_s) return {{start_s, start}};
    return through(track, track.front().time_s, start);
  }
  Track moved = track;
  for (TimedPose& p : moved) p.pose = start * between(*there, p.pose);
  return moved;
}

}  // namespace

Result<Track> predicted_track(const Recording& recording, const Vehicle& vehicle) {
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  if (const auto other = other_than_differential_drive(vehicle, "has a prediction")) return *other;
  const std::vector<WheelSample> wheels = wheel_samples(recording, *drive);
  const std::vector<CommandSample> commands = command_samples(recording);
  if (wheels.empty() && commands.empty())
    return Error{recording.name, "no wheel rotation and no commands",
                 "left_wheel_rad and right_wheel_rad, or left_ticks and right_ticks, or command_speed_mps and "
                 "command_yaw_rate_radps"};
  Track axle = wheels.empty() ? dead_reckoned(commands, Pose{}) : dead_reckoned(wheels, *drive, Pose{});

  const Pose& mounting = vehicle.truth.axle_T_tracked;
  const std::vector<TruthSample> truth = truth_samples(recording);
  Pose start;
  double start_s = axle.front().time_s;
  if (!truth.empty()) {
    start = Pose{truth[0].position.x_m, truth[0].position.y_m, truth[0].heading_rad.value_or(0.0)} * inverse(mounting);
    start_s = truth[0].time_s - vehicle.truth.time_offset_s;
  }
  Track track = through(axle, start_s, start);
  for (TimedPose& p : track) p = {p.time_s + vehicle.truth.time_offset_s, p.pose * mounting};
  for (const TimedPose& p : track)
    if (!std::isfinite(p.pose.x_m + p.pose.y_m + p.pose.heading_rad))
      return Error{recording.name, "wheel rotation or commands beyond all bounds", "a drive that stays on the floor"};
  return track;
}

}  // namespace odolab
