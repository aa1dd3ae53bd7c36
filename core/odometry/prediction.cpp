#include "core/odometry/prediction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/odometry/cast.h"
#include "core/odometry/differential_drive.h"
#include "core/odometry/encoder_trailer.h"
#include "core/odometry/ipec.h"
#include "core/odometry/synchro_drive.h"
#include "core/recording/vehicle_samples.h"

namespace odolab {

namespace {

// The track carried to where it passes through a pose at a time, whichever samples that falls between. Before the
// wheels were read, and after, the vehicle is taken to stand.
Track through(Track track, double start_s, const Pose& start) {
  const Pose there = *pose_at(track, std::clamp(start_s, track.front().time_s, track.back().time_s));
  for (TimedPose& p : track) p.pose = start * between(there, p.pose);
  return track;
}

// The encoders' own track, from the origin; empty where the recording lacks them.
struct ReckonedTrack {
  const Recording& recording;

  Track operator()(const DifferentialDrive& drive) const {
    return dead_reckoned(wheel_samples(recording, drive), drive, Pose{}, HeadingRule::arc);
  }
  Track operator()(const Tracked& vehicle) const { return (*this)(as_differential_drive(vehicle)); }
  Track operator()(const SynchroDrive& drive) const {
    return synchro_reckoned(synchro_samples(recording), drive, Pose{});
  }
  Track operator()(const LinkedTrucks& vehicle) const {
    return track_of_truck_a(ipec(linked_samples(recording), vehicle, Pose{}));
  }
  Track operator()(const EncoderTrailer& vehicle) const {
    return trailer_reckoned(trailer_samples(recording), vehicle, Pose{});
  }
  Track operator()(const SmartEncoderTrailer& vehicle) const {
    return track_of_truck_a(ipec(trailer_samples(recording), vehicle, Pose{}));
  }
  Track operator()(const MultiCastor& vehicle) const {
    return castor_track(castor_samples(recording, vehicle.castors.size()), vehicle, Pose{});
  }
};

}  // namespace

Result<Track> predicted_track(const Recording& recording, const Vehicle& vehicle) {
  Track axle = std::visit(ReckonedTrack{recording}, vehicle.kind);
  if (axle.empty()) axle = dead_reckoned(command_samples(recording), Pose{});
  if (axle.empty()) {
    if (std::holds_alternative<DifferentialDrive>(vehicle.kind) || std::holds_alternative<Tracked>(vehicle.kind))
      return Error{recording.name, "no wheel rotation and no commands",
                   "left_wheel_rad and right_wheel_rad, or left_ticks and right_ticks, or command_speed_mps and "
                   "command_yaw_rate_radps"};
    const std::string missing = missing_columns(recording, vehicle);
    return Error{recording.name, missing.empty() ? "no row in which all encoders can be told" : "no " + missing,
                 "the encoders of a " + kind_name(vehicle) + ", or commands"};
  }

  const Pose& mounting = vehicle.truth.axle_T_tracked;
  const std::vector<TruthSample> truth = truth_samples(recording);
  Pose start;
  double start_s = axle.front().time_s;
  if (!truth.empty()) {
    start = Pose{truth[0].position.x_m, truth[0].position.y_m, truth[0].heading_rad.value_or(0.0)} * inverse(mounting);
    start_s = truth[0].time_s - vehicle.truth.time_offset_s;
  }
  Track track = through(std::move(axle), start_s, start);
  for (TimedPose& p : track) p = {p.time_s + vehicle.truth.time_offset_s, p.pose * mounting};
  return within_bounds(std::move(track), recording);
}

Result<Track> within_bounds(Track track, const Recording& recording) {
  for (const TimedPose& p : track)
    if (!std::isfinite(p.pose.x_m + p.pose.y_m + p.pose.heading_rad))
      return Error{recording.name, "wheel rotation or commands beyond all bounds", "a drive that stays on the floor"};
  return track;
}

}  // namespace odolab
