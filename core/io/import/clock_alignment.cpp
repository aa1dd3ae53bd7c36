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

// Of a[i + shift] with b[i] where both exist.
double correlation(const std::vector<double>& a, const std::vector<double>& b, long shift) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  const long first = std::max(0L, -shift);
  const long last = std::min(static_cast<long>(b.size()), static_cast<long>(a.size()) - shift);
  for (long i = first; i < last; ++i) {
    ab += a[i + shift] * b[i];
    aa += a[i + shift] * a[i + shift];
    bb += b[i] * b[i];
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : -1.0;
}

}  // namespace

double truth_shift_by_turning(const SampledChannels& odometry, const SampledChannels& truth) {
  std::vector<double> turning(odometry.time_s.size());
  for (std::size_t i = 0; i < turning.size(); ++i)
    turning[i] = odometry.channels[1].values[i] - odometry.channels[0].values[i];
  const std::vector<double>& heading_rad = truth.channels[2].values;
  if (odometry.time_s.size() < 2 || truth.time_s.size() < 2) return odometry.time_s.front() - truth.time_s.front();

  const auto best_shift = [&](double step_s, double around_s, double within_s) {
    const std::vector<double> a = changes(odometry.time_s, turning, step_s), b = changes(truth.time_s, heading_rad, step_s);
    const long half = static_cast<long>(std::min(a.size(), b.size()) / 2);
    const long low = std::max(half - static_cast<long>(b.size()), std::lround((around_s - within_s) / step_s));
    const long high = std::min(static_cast<long>(a.size()) - half, std::lround((around_s + within_s) / step_s));
    double best = -2.0, best_s = 0.0;
    for (long shift = low; shift <= high; ++shift)
      if (const double c = correlation(a, b, shift); c > best) {
        best = c;
        best_s = static_cast<double>(shift) * step_s;
      }
    return best_s;
  };
  const double coarse_s = best_shift(kGrid_s, 0.0, 1e6);
  return odometry.time_s.front() - truth.time_s.front() + best_shift(kFineGrid_s, coarse_s, 2.0 * kGrid_s);
}

}  // namespace odolab
