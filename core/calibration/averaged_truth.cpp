#include "core/calibration/averaged_truth.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/base/stamp_digits.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

double usual_interval_s(const std::vector<TruthSample>& truth) {
  std::vector<double> intervals_s;
  for (std::size_t k = 1; k < truth.size(); ++k) intervals_s.push_back(truth[k].time_s - truth[k - 1].time_s);
  return median(std::move(intervals_s));
}

std::vector<Pose> poses_by_filter(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model) {
  std::vector<Pose> poses(run.truth.size());
  FilterOptions options;
  options.derivatives = false;
  options.on_step = [&](const FilterStep& s) { poses[static_cast<std::size_t>(s.truth_index)] = s.pose; };
  filtered(run, summed, model, options);
  return poses;
}

// Whether the wheels' rounding is no small part of what a truth sample errs by.
bool rounding_shows(const InnovationRun& run, const InnovationModel& model) {
  constexpr double kOfTheTruth = 0.2;
  const double count_m = count_rad(run, model.drive) * model.drive.wheel_radius_left_m;
  return !run.smooth.empty() && count_m / std::sqrt(12.0) > kOfTheTruth * model.noise.truth_position_m;
}

// From a sample of the truth on.
Pose motion_until(const InnovationRun& run, const InnovationModel& model, const TruthSample& from, double until_s) {
  if (!(until_s > from.time_s)) return {};
  InnovationRun part;
  part.speeds_are_held = run.speeds_are_held;
  const auto is_before = [](const WheelSample& w, double time_s) { return w.time_s < time_s; };
  const double late_s = model.truth.time_offset_s;
  auto first = std::lower_bound(run.wheels.begin(), run.wheels.end(), from.time_s - late_s, is_before),
       last = std::lower_bound(first, run.wheels.end(), until_s - late_s, is_before);
  if (first != run.wheels.begin()) --first;
  if (last != run.wheels.end()) ++last;
  if (last - first < 2) return {};
  part.wheels.assign(first, last);
  part.truth = {from, {until_s, {}, {}}};
  part.set_aside.assign(part.truth.size(), 0);
  return summed_up(part, model).motions.front().motion;
}

}  // namespace

double averaging_s(const InnovationRun& run) {
  constexpr double kOfATurn = 0.1, kFast = 0.95;
  // How a base follows a change of its command may be over within a few hundredths of a second.
  const double longest_s = run.speeds_are_held ? 0.02 : 0.05;
  std::vector<double> speeds_radps;
  for (std::size_t i = 1; i < run.wheels.size(); ++i) {
    const WheelSample &a = run.wheels[i - 1], &b = run.wheels[i];
    speeds_radps.push_back(std::max(std::abs(b.left_rad - a.left_rad), std::abs(b.right_rad - a.right_rad)) /
                           (b.time_s - a.time_s));
  }
  const double fast_radps = quantile(std::move(speeds_radps), kFast);
  return fast_radps * longest_s > kOfATurn * 2.0 * kPi ? kOfATurn * 2.0 * kPi / fast_radps : longest_s;
}

InnovationRun with_averaged_truth(const InnovationRun& run, const InnovationModel& model, double longest_s) {
  const double interval_s = usual_interval_s(run.truth);
  const auto most = static_cast<std::size_t>(longest_s / interval_s + 0.01);
  if (most < 2) return run;
  InnovationRun carries = run;
  const bool smoothed = rounding_shows(run, model);
  if (smoothed) carries.wheels = run.smooth;
  const SummedRun summed = summed_up(carries, model);
  const std::vector<Pose> poses = poses_by_filter(carries, summed, model);
  InnovationRun out = run;
  out.truth.clear();
  out.set_aside.clear();
  out.cut.clear();
  const std::size_t n = run.truth.size();
  for (std::size_t first = 0, end; first < n; first = end) {
    const double until_s = run.truth[first].time_s + (static_cast<double>(most) - 0.5) * interval_s - kStampDigits_s;
    for (end = first + 1; end < n && end - first < most && run.truth[end].time_s < until_s && !is_cut(run, end);) ++end;
    // Where all of them contradict the model they are one sample that does, for others to judge.
    const auto of_set_aside =
        std::count_if(run.set_aside.begin() + static_cast<std::ptrdiff_t>(first),
                      run.set_aside.begin() + static_cast<std::ptrdiff_t>(end), [](char aside) { return aside != 0; });
    const bool are_all = static_cast<std::size_t>(of_set_aside) == end - first;
    Pose axle = poses[first], sum;  // of what the truth has beyond the prediction
    std::vector<Pose> predicted;
    double times_s = 0.0, used = 0.0, headings = 0.0;  // times since the first
    for (std::size_t k = first; k < end; ++k) {
      if (k > first) axle = axle * summed.motions[k - 1].motion;
      predicted.push_back(axle * model.truth.axle_T_tracked);
      if (run.set_aside[k] && !are_all) continue;
      const TruthSample& t = run.truth[k];
      sum.x_m += t.position.x_m - predicted.back().x_m;
      sum.y_m += t.position.y_m - predicted.back().y_m;
      if (t.heading_rad) sum.heading_rad += wrapped(*t.heading_rad - predicted.back().heading_rad), ++headings;
      times_s += t.time_s - run.truth[first].time_s;
      ++used;
    }
    std::size_t middle = first;
    const auto away_s = [&](std::size_t k) {
      return std::abs(run.truth[k].time_s - run.truth[first].time_s - times_s / used);
    };
    // Of an even number two are in the middle: the earlier one, and not whichever the last digit of a stamp makes it.
    for (std::size_t k = first + 1; k < end; ++k)
      if (away_s(k) < away_s(middle) - kStampDigits_s) middle = k;
    TruthSample mean = run.truth[middle];
    Pose at = predicted[middle - first];
    // What a base does is not what it was told: carried to the earlier of two it would be ahead by half of what is
    // between them.
    if (run.speeds_are_held) {
      mean.time_s = run.truth[first].time_s + times_s / used;
      at = poses[first] * motion_until(carries, model, run.truth[first], mean.time_s) * model.truth.axle_T_tracked;
    }
    mean.position = {at.x_m + sum.x_m / used, at.y_m + sum.y_m / used};
    mean.heading_rad.reset();
    if (headings > 0.0) mean.heading_rad = at.heading_rad + sum.heading_rad / headings;
    out.truth.push_back(mean);
    out.set_aside.push_back(0);
    out.truth_variance.push_back(static_cast<double>(most) / used);
    out.cut.push_back(is_cut(run, first));
  }
  const double readings_s =
      (run.wheels.back().time_s - run.wheels.front().time_s) / static_cast<double>(run.wheels.size() - 1);
  out.samples_averaged = static_cast<double>(most);
  if (!smoothed)
    out.readings_averaged = std::clamp(out.samples_averaged * interval_s / readings_s, 1.0, out.samples_averaged);
  return out;
}

}  // namespace odolab
