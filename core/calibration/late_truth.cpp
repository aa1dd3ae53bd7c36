#include "core/calibration/late_truth.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/wheels_at.h"

namespace odolab {

namespace {

constexpr double kBin_s = 0.1, kFurthest_s = 60.0, kNearest_s = 0.4;
constexpr double kPlainly = 0.8, kNotAtAll = 0.6;  // correlations

// Of each bin of time: by how much `value` grew, from pairs of time and value in order.
template <typename Sample, typename Value>
std::vector<double> growth(const std::vector<Sample>& samples, double start_s, double end_s, Value&& value) {
  std::vector<double> out;
  double before = 0.0;
  for (double t = start_s; t < end_s; t += kBin_s) {
    const auto [after, share] = place_between(samples, t);
    const double from = value(after - 1), now = from + share * (value(after) - from);
    if (t > start_s) out.push_back(now - before);
    before = now;
  }
  return out;
}

// Of what both have at that lag (bins that the truth is late); none where that is too little.
std::optional<double> correlation(const std::vector<double>& wheels, const std::vector<double>& truth, int lag) {
  constexpr int kFewest = 50;
  const int from = std::max(0, -lag),
            to = std::min(static_cast<int>(wheels.size()), static_cast<int>(truth.size()) - lag);
  if (to - from < kFewest) return std::nullopt;
  double w = 0.0, t = 0.0, ww = 0.0, tt = 0.0, wt = 0.0;
  for (int k = from; k < to; ++k) {
    const double a = wheels[static_cast<std::size_t>(k)], b = truth[static_cast<std::size_t>(k + lag)];
    w += a, t += b, ww += a * a, tt += b * b, wt += a * b;
  }
  const double n = to - from, varies = (ww - w * w / n) * (tt - t * t / n);
  if (varies <= 0.0) return std::nullopt;
  return (wt - w * t / n) / std::sqrt(varies);
}

std::optional<double> lag_of(const InnovationRun& run) {
  const std::vector<TruthSample>& truth = run.truth;
  if (truth.size() < 2 || run.wheels.size() < 2) return std::nullopt;
  const double start_s = std::min(run.wheels.front().time_s, truth.front().time_s),
               end_s = std::max(run.wheels.back().time_s, truth.back().time_s);
  std::vector<double> by_truth(truth.size(), 0.0);
  for (std::size_t i = 1; i < truth.size(); ++i)
    by_truth[i] =
        by_truth[i - 1] + (run.truth_has_heading
                               ? wrapped(truth[i].heading_rad.value_or(0.0) - truth[i - 1].heading_rad.value_or(0.0))
                               : length(truth[i].position - truth[i - 1].position));
  const auto of_wheels = [&](std::size_t i) {
    const WheelSample& w = run.wheels[i];
    return run.truth_has_heading ? w.right_rad - w.left_rad : w.right_rad + w.left_rad;
  };
  const std::vector<double> wheels = growth(run.wheels, start_s, end_s, of_wheels),
                            seen = growth(truth, start_s, end_s, [&](std::size_t i) { return by_truth[i]; });
  const int furthest = static_cast<int>(std::min(kFurthest_s, 0.5 * (end_s - start_s)) / kBin_s);
  double best = kPlainly;
  std::optional<double> lag_s;
  for (int lag = -furthest; lag <= furthest; ++lag)
    if (const std::optional<double> c = correlation(wheels, seen, lag); c && *c > best) best = *c, lag_s = lag * kBin_s;
  if (!lag_s || std::abs(*lag_s) < kNearest_s || correlation(wheels, seen, 0).value_or(0.0) > kNotAtAll)
    return std::nullopt;
  return lag_s;
}

}  // namespace

std::optional<double> late_truth_s(const std::vector<InnovationRun>& runs) {
  constexpr double kAlike_s = 0.5;
  std::vector<double> lags;
  for (const InnovationRun& run : runs) {
    const std::optional<double> lag = lag_of(run);
    if (!lag) return std::nullopt;
    lags.push_back(*lag);
  }
  if (lags.empty()) return std::nullopt;
  std::sort(lags.begin(), lags.end());
  if (lags.back() - lags.front() > kAlike_s) return std::nullopt;
  return lags[lags.size() / 2];
}

}  // namespace odolab
