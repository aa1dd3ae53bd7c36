#include "core/guide/recorded_run.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/differential_drive.h"

namespace odolab {

Result<GuideRun> run_in(const Recording& recording, const Vehicle& nominal) {
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (!drive) return Error{recording.name, kind_name(nominal), "a differential drive"};
  const std::vector<WheelSample> wheels = wheel_samples(recording, *drive);
  if (wheels.size() < 2) return Error{recording.name, "no wheel rotation", "columns of both wheels"};
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (truth.size() < 2 || !truth.front().heading_rad || !truth.back().heading_rad)
    return Error{recording.name, "no true pose with a heading at the start and the end",
                 "a measured pose at both ends"};
  const auto axle = [&](const TruthSample& t) {
    return Pose{t.position.x_m, t.position.y_m, *t.heading_rad} * inverse(nominal.truth.axle_T_tracked);
  };
  GuideRun run;
  run.measured = between(axle(truth.front()), axle(truth.back()));
  // From the one measurement to the other, which may be on the way: before the first reading and behind the last it
  // stands.
  const Track track = dead_reckoned(wheels, *drive, Pose{});
  const auto believed = [&](const TruthSample& t) {
    const double at_s = t.time_s - nominal.truth.time_offset_s;
    return *pose_at(track, std::clamp(at_s, track.front().time_s, track.back().time_s));
  };
  run.odometry = between(believed(truth.front()), believed(truth.back()));
  constexpr double kThreeCorners = 1.5 * kPi;
  const double turned_rad = run.odometry.heading_rad;
  if (std::abs(turned_rad) < kThreeCorners)
    return Error{recording.name, "a drive that turned by less than three corners in one direction",
                 "a square, clockwise or counter-clockwise"};
  run.clockwise = turned_rad < 0.0;
  run.odometry.heading_rad = wrapped(turned_rad);
  run.measured.heading_rad = unwrapped(run.measured.heading_rad, run.odometry.heading_rad);
  run.has_heading = true;
  run.source = recording.name;
  return run;
}

}  // namespace odolab
