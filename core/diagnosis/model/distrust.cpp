// How little the likelihood is to be believed.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/correlation.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

namespace {

// What is hidden behind a wheel's count is even over it; and behind another one, so many counts later: their
// covariance, in counts squared.
double covariance_of_remainders(double counts_later) {
  const double f = counts_later - std::floor(counts_later);
  return 1.0 / 12.0 - 0.5 * f * (1.0 - f);
}

// A time between two readings: the one before it, and how much of what is hidden is that of the one behind.
struct Between {
  std::size_t before;
  double share;
};

Between between(const std::vector<WheelSample>& readings, double time_s) {
  const auto behind = std::lower_bound(readings.begin() + 1, readings.end() - 1, time_s,
                                       [](const WheelSample& w, double t) { return w.time_s < t; });
  const auto before = behind - 1;
  const double span_s = behind->time_s - before->time_s;
  return {static_cast<std::size_t>(before - readings.begin()),
          span_s > 0.0 ? std::clamp((time_s - before->time_s) / span_s, 0.0, 1.0) : 0.0};
}

// The products of whitened innovations so many samples apart that whole counts alone are to be thought of, along and in
// heading, summed over a run.
std::array<double, 3> products_of_remainders(const InnovationRun& run, const std::vector<FilterStep>& steps,
                                             const InnovationModel& model, int samples_apart) {
  std::array<double, 3> sum{};
  const DifferentialDrive& d = model.drive;
  const double count = count_rad(run, d);
  const std::vector<WheelSample>& smooth = run.smooth.empty() ? run.wheels : run.smooth;
  if (count == 0.0 || smooth.size() < 2) return sum;
  const auto of_wheel = [&](double WheelSample::*rotation, const Between& a, const Between& b) {
    double covariance = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        covariance +=
            (i == 0 ? 1.0 - a.share : a.share) * (j == 0 ? 1.0 - b.share : b.share) *
            covariance_of_remainders((smooth[b.before + j].*rotation - smooth[a.before + i].*rotation) / count);
    return count * count * covariance;
  };
  std::vector<Between> at;
  for (const TruthSample& t : run.truth) at.push_back(between(run.wheels, t.time_s - model.truth.time_offset_s));
  for (std::size_t i = static_cast<std::size_t>(samples_apart); i < steps.size(); ++i) {
    const FilterStep &now = steps[i], &then = steps[i - static_cast<std::size_t>(samples_apart)];
    if (!now.used || !then.used) continue;
    const Between &a = at[i - static_cast<std::size_t>(samples_apart)], &b = at[i];
    const double ways_m2 = d.wheel_radius_left_m * d.wheel_radius_left_m * of_wheel(&WheelSample::left_rad, a, b) +
                           d.wheel_radius_right_m * d.wheel_radius_right_m * of_wheel(&WheelSample::right_rad, a, b);
    sum[0] += 0.25 * ways_m2 / std::max(0.5 * (now.covariance[0] + now.covariance[3]), 1e-300);
    if (now.size == 3) sum[2] += ways_m2 / (d.wheelbase_m * d.wheelbase_m) / std::max(now.covariance[5], 1e-300);
  }
  return sum;
}

// Of a channel of the whitened innovations: one where sums of them scatter as the model says.
double scatter_of_sums(const std::vector<LinearisedRun>& runs, std::size_t channel) {
  std::vector<std::vector<double>> innovations;
  double square = 0.0;
  int used = 0;
  for (const LinearisedRun& linear : runs) {
    const Whitened& r = linear.residual();
    innovations.emplace_back();
    for (std::size_t i = channel; i < r.size(); i += 3) {
      innovations.back().push_back(r[i]);
      square += r[i] * r[i];
      used += r[i] != 0.0;  // of what was set aside nothing is left
    }
  }
  return square / std::max(1, used) * sum_widened_by_correlation(innovations);
}

}  // namespace

// Correlation of each whitened innovation with that before, the largest of the three channels. That of a floor whose
// unevenness has a length is negative, or makes up for samples that scatter less than the model says, since the noise
// was fitted to what adds up: correlations count as far as sums scatter more. Samples beside the same reading of
// the encoders share its rounding and say nothing of the model: "before" is two readings ago and more. But what happens
// at one moment is not told from just that rounding: for it, samples between the same two readings alone do not count.
// At an even speed of nearly whole counts from reading to reading remainders last longer: what they alone make, twice
// at most since a filter follows what lasts, is no reason for distrust.
double JointModel::distrust(bool of_a_moment) const {
  constexpr double kWhite = 0.04, kCorrelated = 0.12;  // of one channel: what chance and a rough floor make; not white
  constexpr double kOfRemainders = 2.0;
  const double readings = of_a_moment ? 1.5 : 2.5;
  double product[3] = {}, square[3] = {}, of_remainders[3] = {};
  for (std::size_t run = 0; run < now_->runs.size(); ++run) {
    const Whitened& r = now_->runs[run].residual();
    const auto period_s = [](const auto& samples) {
      return (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
    };
    const double apart = readings * period_s(runs_[run].wheels) / period_s(runs_[run].truth);
    const int samples_apart = static_cast<int>(std::clamp(apart, 1.0, 100.0));
    const auto lag = 3 * static_cast<std::size_t>(samples_apart);
    for (std::size_t i = lag; i < r.size(); ++i) {
      product[i % 3] += r[i] * r[i - lag];
      square[i % 3] += r[i] * r[i];
    }
    const std::array<double, 3> hidden =
        products_of_remainders(runs_[run], now_->runs[run].steps(), model_of(static_cast<int>(run)), samples_apart);
    for (int k = 0; k < 3; ++k) of_remainders[k] += hidden[static_cast<std::size_t>(k)];
  }
  double most = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (square[k] <= 0.0) continue;
    const double correlation = (product[k] - kOfRemainders * std::max(of_remainders[k], 0.0)) / square[k];
    if (correlation > std::max(most, kWhite))
      most = std::max(most, std::min(correlation, 0.5 * (scatter_of_sums(now_->runs, k) - 1.0)));
  }
  return std::clamp((most - kWhite) / (kCorrelated - kWhite), 0.0, 1.0);
}

double JointModel::wider_by_correlation() const {
  double widest = 1.0;
  for (std::size_t channel = 0; channel < 3; ++channel) widest = std::max(widest, scatter_of_sums(now_->runs, channel));
  return widest;
}

}  // namespace odolab
