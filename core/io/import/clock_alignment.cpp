#include "core/io/import/clock_alignment.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kGrid_s = 0.05;
constexpr double kFineGrid_s = 0.01;

// Differences over `kGrid_s` on a grid of `step_s` that begins at the first stamp.
std::vector<double> changes(const std::vector<double>& time_s, const std::vector<double>& values, double step_s) {
  std::vector<double> result;
  const auto at = [&](double t, std::size_t& k) {
    while (k + 1 < time_s.size() && time_s[k] < t) ++k;
    if (k == 0) return values[0];
    const double span = time_s[k] - time_s[k - 1];
    return values[k - 1] + (span > 0.0 ? std::min(1.0, (t - time_s[k - 1]) / span) : 1.0) * (values[k] - values[k - 1]);
  };
  std::size_t before = 0, after = 0;
  for (double t = time_s.front(); t + kGrid_s <= time_s.back(); t += step_s)
    result.push_back(at(t + kGrid_s, after) - at(t, before));
  return result;
}

double energy(const std::vector<double>& a) {
  double sum = 0.0;
  for (double v : a) sum += v * v;
  return sum;
}

// Sum of a[i + shift] b[i] where both exist: what does not overlap counts as not agreeing.
double overlap_product(const std::vector<double>& a, const std::vector<double>& b, long shift) {
  double sum = 0.0;
  const long first = std::max(0L, -shift);
  const long last = std::min(static_cast<long>(b.size()), static_cast<long>(a.size()) - shift);
  for (long i = first; i < last; ++i) sum += a[i + shift] * b[i];
  return sum;
}

struct Fit {
  double correlation = -2.0;
  double shift_s = 0.0;  // of the first stamps against each other
};

Fit best_shift(const std::vector<double>& a, const std::vector<double>& b, double step_s, double from_s, double to_s) {
  Fit best;
  const double scale = std::sqrt(energy(a) * energy(b));
  if (!(scale > 0.0)) return best;
  const long low = std::max(-static_cast<long>(b.size()), std::lround(from_s / step_s));
  const long high = std::min(static_cast<long>(a.size()), std::lround(to_s / step_s));
  for (long shift = low; shift <= high; ++shift)
    if (const double c = overlap_product(a, b, shift) / scale; c > best.correlation)
      best = {c, static_cast<double>(shift) * step_s};
  return best;
}

}  // namespace

double truth_shift_by_turning(const SampledChannels& odometry, const SampledChannels& truth) {
  const double first_stamps_s = odometry.time_s.front() - truth.time_s.front();
  std::vector<double> turning(odometry.time_s.size());
  for (std::size_t i = 0; i < turning.size(); ++i)
    turning[i] = odometry.channels[1].values[i] - odometry.channels[0].values[i];
  const std::vector<double>& heading_rad = truth.channels[2].values;

  const auto scaled = [&](double rate) {
    std::vector<double> time_s = truth.time_s;
    for (double& t : time_s) t = rate * (t - truth.time_s.front());
    return time_s;
  };
  Fit best;
  double best_rate = 1.0;
  const std::vector<double> coarse = changes(odometry.time_s, turning, kGrid_s);
  for (int k = -20; k <= 20; ++k) {
    const double rate = 1.0 + 0.002 * k;
    const Fit fit = best_shift(coarse, changes(scaled(rate), heading_rad, kGrid_s), kGrid_s, -1e6, 1e6);
    if (fit.correlation <= best.correlation) continue;
    best = fit;
    best_rate = rate;
  }
  if (best.correlation < -1.0) return first_stamps_s;  // nothing turns
  best =
      best_shift(changes(odometry.time_s, turning, kFineGrid_s), changes(scaled(best_rate), heading_rad, kFineGrid_s),
                 kFineGrid_s, best.shift_s - 2.0 * kGrid_s, best.shift_s + 2.0 * kGrid_s);
  // the odometry's first stamp falls on this stamp of the truth's own clock
  return first_stamps_s + best.shift_s / best_rate;
}

}  // namespace odolab
