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
    if (const double off_s = run.truth[first].time_s + times_s / used - mean.time_s;
        run.speeds_are_held && middle + 1 < end && off_s > kStampDigits_s) {
      const Pose& next = predicted[middle + 1 - first];
      const double share = off_s / (run.truth[middle + 1].time_s - mean.time_s);
      at = {at.x_m + share * (next.x_m - at.x_m), at.y_m + share * (next.y_m - at.y_m),
            at.heading_rad + share * (next.heading_rad - at.heading_rad)};
      mean.time_s += off_s;
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
