#include "core/calibration/thinned_truth.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/pose_covariance.h"

namespace odolab {

namespace {

// One motion and then another, each in the frame of its own start.
RelativeMotion followed(const RelativeMotion& first, const RelativeMotion& then) {
  const double c = std::cos(first.motion.heading_rad), s = std::sin(first.motion.heading_rad);
  const double dx = c * then.motion.x_m - s * then.motion.y_m, dy = s * then.motion.x_m + c * then.motion.y_m;
  RelativeMotion both;
  both.motion = {first.motion.x_m + dx, first.motion.y_m + dy, first.motion.heading_rad + then.motion.heading_rad};
  const auto add_up = [&](const double* of_first, const double* of_then, double* into) {
    PoseCovariance sum = PoseCovariance::packed(of_first).carried(dx, dy);
    sum.add(PoseCovariance::packed(of_then).turned(c, s));
    sum.pack(into);
  };
  add_up(first.wheel_noise, then.wheel_noise, both.wheel_noise);
  add_up(first.along_noise, then.along_noise, both.along_noise);
  add_up(first.turning_noise, then.turning_noise, both.turning_noise);
  add_up(first.sideways_noise, then.sideways_noise, both.sideways_noise);
  add_up(first.timing_noise, then.timing_noise, both.timing_noise);
  add_up(first.count_noise, then.count_noise, both.count_noise);
  return both;
}

}  // namespace

ThinnedTruth thinned_truth(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                           double way_m) {
  ThinnedTruth out;
  InnovationRun& thin = out.run;
  thin.name = run.name;
  thin.truth_has_heading = run.truth_has_heading;
  thin.counts_show = run.counts_show;
  thin.readings_averaged = run.readings_averaged;
  RelativeMotion since;
  double left_m = 0.0, right_m = 0.0;  // rolled since the last sample that was kept, there and back
  std::size_t i = 0;
  for (std::size_t t = 0; t < run.truth.size(); ++t) {
    if (t > 0) since = followed(since, summed.motions[t - 1]);
    const double now_s = run.truth[t].time_s - model.truth.time_offset_s;
    for (; i + 1 < run.wheels.size() && run.wheels[i + 1].time_s <= now_s; ++i) {
      left_m += model.drive.wheel_radius_left_m * std::abs(run.wheels[i + 1].left_rad - run.wheels[i].left_rad);
      right_m += model.drive.wheel_radius_right_m * std::abs(run.wheels[i + 1].right_rad - run.wheels[i].right_rad);
    }
    const bool begins_anew = run.set_aside[t] == 2 || is_cut(run, t);
    const bool rolled = run.set_aside[t] == 0 && std::max(left_m, right_m) >= way_m;
    if (t > 0 && !begins_anew && !rolled) continue;
    thin.truth.push_back(run.truth[t]);
    thin.set_aside.push_back(run.set_aside[t]);
    if (!run.truth_variance.empty()) thin.truth_variance.push_back(run.truth_variance[t]);
    thin.cut.push_back(is_cut(run, t));
    if (t > 0) out.summed.motions.push_back(since);
    since = {};
    left_m = right_m = 0.0;
  }
  return out;
}

}  // namespace odolab
