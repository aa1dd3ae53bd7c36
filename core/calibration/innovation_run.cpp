// From a recording to what the filter reads.
#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/calibration/evened_recording.h"
#include "core/calibration/frozen_truth.h"
#include "core/calibration/innovations.h"
#include "core/calibration/left_out.h"
#include "core/calibration/repeated_stamps.h"
#include "core/calibration/rests.h"
#include "core/calibration/slow_counts.h"
#include "core/calibration/smoothed_readings.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

// Whether rotations are whole counts: interpolated or ideal ones are not, and have no rounding error.
bool lie_on_counts(const std::vector<WheelSample>& wheels, const DifferentialDrive& drive) {
  const double counts_per_rad = drive.counts_per_wheel_turn() / (2.0 * kPi);
  std::size_t on = 0;
  const auto whole = [&](double rad, double first_rad) {
    const double counts = (rad - first_rad) * counts_per_rad;
    return std::abs(counts - std::round(counts)) < 0.01;
  };
  for (const WheelSample& w : wheels)
    on += whole(w.left_rad, wheels.front().left_rad) && whole(w.right_rad, wheels.front().right_rad);
  return static_cast<double>(on) > 0.95 * static_cast<double>(wheels.size());
}

// Truth that repeats itself to the last bit while the wheels drive on is not a measurement.
int leave_out_frozen(std::vector<TruthSample>& truth, const std::vector<WheelSample>& wheels,
                     const DifferentialDrive& drive, double truth_late_s) {
  const TimeStretches frozen = frozen_truth(truth, wheels, drive, truth_late_s);
  return static_cast<int>(std::erase_if(truth, [&](const TruthSample& t) {
    return std::any_of(frozen.begin(), frozen.end(),
                       [&](const auto& stretch) { return t.time_s > stretch.first && t.time_s <= stretch.second; });
  }));
}
// How fast a wheel goes at most from the first reading on, over a quarter of a second; a wheel that stands may be read
// on either side of a count. Zero where a reading comes again.
template <typename Readings>
double speed_at(const Readings& first, const Readings& end, const DifferentialDrive& drive) {
  constexpr double kOver_s = 0.25;
  const double count = 2.0 * kPi / drive.counts_per_wheel_turn();
  auto last = std::next(first);
  if (last->left_rad == first->left_rad && last->right_rad == first->right_rad) return 0.0;
  while (std::next(last) != end && std::abs(last->time_s - first->time_s) < kOver_s) ++last;
  const auto way_m = [&](double radius_m, double turned_rad) {
    return radius_m * std::max(0.0, std::abs(turned_rad) - 1.01 * count);
  };
  return std::max(way_m(drive.wheel_radius_left_m, last->left_rad - first->left_rad),
                  way_m(drive.wheel_radius_right_m, last->right_rad - first->right_rad)) /
         std::abs(last->time_s - first->time_s);
}

}  // namespace

Result<InnovationRun> innovation_run(const Recording& as_logged, const Vehicle& vehicle,
                                     const std::optional<std::vector<std::pair<double, double>>>& given_left_out) {
  const DifferentialDrive& drive = std::get<DifferentialDrive>(vehicle.kind);
  const std::string where = as_logged.name.empty() ? "recording" : as_logged.name;
  if (const std::vector<std::string> problems = problems_in(as_logged); !problems.empty())
    return Error{where, "", problems.front()};
  InnovationRun run;
  std::optional<EvenedRecording> even;
  if (!given_left_out) even = evened(as_logged, drive);
  if (even) run.warnings = even->said;
  const Recording& recording = even ? even->recording : as_logged;
  run.name = where;
  run.wheels = without_repeated(wheel_samples(recording, drive));
  if (run.wheels.empty())
    return Error{where, "no wheel rotation", "left_wheel_rad and right_wheel_rad, or left_ticks and right_ticks"};
  if (run.wheels.size() < 2)
    return Error{where, "wheel rotation at one time alone", "two readings or more, at times that go on"};

  const TimeStretches left_out = given_left_out ? *given_left_out : encoder_gaps(run.wheels);
  run.wheels = bridged(std::move(run.wheels), left_out, 2.0 * kPi / drive.counts_per_wheel_turn());
  if (run.wheels.size() < 2)
    return Error{where, "no wheel rotation outside of what is at fault", "two readings or more"};
  for (const auto& [from_s, to_s] : left_out) {
    const auto earlier = [](const WheelSample& w, double time_s) { return w.time_s < time_s; };
    const auto first = std::lower_bound(run.wheels.begin(), run.wheels.end(), from_s, earlier);
    const auto last = std::lower_bound(first, run.wheels.end(), to_s, earlier);
    run.left_out.emplace_back((first == run.wheels.begin() ? first : first - 1)->time_s,
                              (run.wheels.end() - last > 1 ? last + 1 : run.wheels.end() - 1)->time_s);
  }

  // Which truth lies within the time of the wheels is only known with its clock.
  const double span_s = run.wheels.back().time_s - run.wheels.front().time_s;
  const double beyond_s = span_s / static_cast<double>(run.wheels.size() - 1) + 1e-9;
  const std::vector<TruthSample> all_truth = truth_samples(recording);
  // Of poses at both ends alone each counts: one a little before or behind is kept if the wheels hardly moved until
  // then.
  constexpr std::size_t kFew = 5;
  constexpr double kHardly_m = 0.001, kLittle_s = 0.5;
  const auto reach_s = [&](double speed_mps) {
    return all_truth.size() < kFew ? std::max(beyond_s, std::min(kLittle_s, kHardly_m / speed_mps)) : beyond_s;
  };
  const double first_s = run.wheels.front().time_s - reach_s(speed_at(run.wheels.begin(), run.wheels.end(), drive)),
               last_s = run.wheels.back().time_s + reach_s(speed_at(run.wheels.rbegin(), run.wheels.rend(), drive));
  std::vector<TruthSample> truth;
  for (const TruthSample& t : all_truth) {
    const double time_s = t.time_s - vehicle.truth.time_offset_s;
    if (time_s < first_s || time_s > last_s) continue;
    if (truth.empty() || t.time_s > truth.back().time_s) truth.push_back(t);
  }
  run.frozen = leave_out_frozen(truth, run.wheels, drive, vehicle.truth.time_offset_s);
  const auto with_heading =
      std::count_if(truth.begin(), truth.end(), [](const TruthSample& t) { return t.heading_rad.has_value(); });
  run.truth_has_heading = 2 * with_heading > static_cast<std::ptrdiff_t>(truth.size());
  for (const TruthSample& t : truth) {
    if (run.truth.empty() && run.truth_has_heading && !t.heading_rad)
      continue;  // a start needs a heading where there is one
    run.truth.push_back(t);
    if (!run.truth_has_heading) run.truth.back().heading_rad.reset();
  }
  if (run.truth.empty() && all_truth.size() > 1 &&
      (all_truth.front().time_s - vehicle.truth.time_offset_s > last_s ||
       all_truth.back().time_s - vehicle.truth.time_offset_s < first_s))
    return Error{
        where,
        formatted("truth from %.1f to %.1f s, where the wheels were read from %.1f to %.1f s", all_truth.front().time_s,
                  all_truth.back().time_s, run.wheels.front().time_s, run.wheels.back().time_s),
        formatted("both by one clock, or in the vehicle's file how late the truth's is: "
                  "truth_mounting.time_offset_s = %.1f if both began together",
                  all_truth.front().time_s - run.wheels.front().time_s)};
  if (run.truth.size() < 2)
    return Error{where, std::to_string(run.truth.size()) + " truth samples within the time of the wheels",
                 "two or more of truth_x_m and truth_y_m"};
  run.set_aside.assign(run.truth.size(), 0);
  run.counts_show = lie_on_counts(run.wheels, drive);
  if (run.counts_show) {
    run.settles.assign(run.wheels.size() - 1, 0);
    for (const RestEdge& e : rest_edges(run.wheels, &WheelSample::left_rad)) run.settles[e.interval] |= 1;
    for (const RestEdge& e : rest_edges(run.wheels, &WheelSample::right_rad)) run.settles[e.interval] |= 2;
    run.wheels = with_slow_counts_drawn(run.wheels, count_rad(run, drive));
  }
  run.smooth = smoothed(run.wheels);
  cut_where_left_out(run, vehicle.truth.time_offset_s);
  return run;
}

std::vector<DriveStep> drive_steps(const InnovationRun& run, const DifferentialDrive& drive) {
  std::vector<DriveStep> steps;
  steps.reserve(run.wheels.size() - 1);
  Pose pose{run.truth.front().position.x_m, run.truth.front().position.y_m,
            run.truth.front().heading_rad.value_or(0.0)};
  for (std::size_t i = 0; i + 1 < run.wheels.size(); ++i) {
    const WheelSample &a = run.wheels[i], &b = run.wheels[i + 1];
    DriveStep step;
    step.time_s = 0.5 * (a.time_s + b.time_s);
    step.duration_s = b.time_s - a.time_s;
    step.left_m = drive.wheel_radius_left_m * (b.left_rad - a.left_rad);
    step.right_m = drive.wheel_radius_right_m * (b.right_rad - a.right_rad);
    step.turn_rad = (step.right_m - step.left_m) / drive.wheelbase_m;
    const Pose next = dead_reckoned(pose, b.left_rad - a.left_rad, b.right_rad - a.right_rad, drive);
    step.heading_rad = pose.heading_rad + 0.5 * step.turn_rad;
    step.position = 0.5 * (pose.position() + next.position());
    pose = next;
    steps.push_back(step);
  }
  return steps;
}
}  // namespace odolab
