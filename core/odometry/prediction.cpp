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

  const TimedPose start = predicted_start(recording, vehicle.truth, axle.front().time_s);
  return within_bounds(as_tracked(through(std::move(axle), start), vehicle.truth), recording);
}

TimedPose predicted_start(const Recording& recording, const TruthMounting& mounting, double without_truth_s) {
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (truth.empty()) return {without_truth_s, Pose{}};
  const TruthSample& first = truth.front();
  const Pose tracked{first.position.x_m, first.position.y_m, first.heading_rad.value_or(0.0)};
  return {first.time_s - mounting.time_offset_s, tracked * inverse(mounting.axle_T_tracked)};
}

Track through(Track axle, const TimedPose& start) {
  const Pose there = *pose_at(axle, std::clamp(start.time_s, axle.front().time_s, axle.back().time_s));
  for (TimedPose& p : axle) p.pose = start.pose * between(there, p.pose);
  return axle;
}

Track as_tracked(Track axle, const TruthMounting& mounting) {
  for (TimedPose& p : axle) p = {p.time_s + mounting.time_offset_s, p.pose * mounting.axle_T_tracked};
  return axle;
}

Result<Track> within_bounds(Track track, const Recording& recording) {
  for (const TimedPose& p : track)
    if (!std::isfinite(p.pose.x_m + p.pose.y_m + p.pose.heading_rad))
      return Error{recording.name, "wheel rotation or commands beyond all bounds", "a drive that stays on the floor"};
  return track;
}

}  // namespace odolab
