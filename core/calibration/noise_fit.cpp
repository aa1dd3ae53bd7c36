#include "core/calibration/noise_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/calibration/descent.h"

namespace odolab {

void NoiseSlopes::add(const NoiseSlopes& other) {
  value += other.value;
  for (std::size_t k = 0; k < slope.size(); ++k) slope[k] += other.slope[k];
  for (std::size_t k = 0; k < curvature.size(); ++k) curvature[k] += other.curvature[k];
  scalars += other.scalars;
}

double& size_of(FittedNoise& noise, int size) {
  switch (size) {
    case noise_size::wheel:
      return noise.wheel_m_per_sqrt_m;
    case noise_size::position:
      return noise.truth_position_m;
    case noise_size::heading:
      return noise.truth_heading_rad;
    case noise_size::along:
      return noise.along_m_per_sqrt_m;
    case noise_size::turning:
      return noise.turning_m_per_sqrt_m;
    case noise_size::wander:
      return noise.wander_m_per_sqrt_s;
    case noise_size::heading_wander:
      return noise.heading_wander_rad_per_sqrt_s;
    case noise_size::command_timing:
      return noise.command_timing_s;
    default:
      return noise.sideways_m_per_sqrt_m;
  }
}

std::vector<NoiseStretch> noise_stretches(const std::vector<const InnovationRun*>& runs, int every, int samples) {
  const auto length = [&](int r) {
    const InnovationRun& run = *runs[static_cast<std::size_t>(r)];
    return std::tuple{run.truth.size(), run.wheels.size(), run.truth.back().time_s - run.truth.front().time_s};
  };
  std::vector<int> counted(runs.size());
  std::iota(counted.begin(), counted.end(), 0);
  std::stable_sort(counted.begin(), counted.end(), [&](int a, int b) { return length(a) < length(b); });
  std::vector<NoiseStretch> stretches;
  int number = 0;
  for (const int r : counted) {
    const int n = static_cast<int>(runs[static_cast<std::size_t>(r)]->truth.size());
    if (every == 1) {
      stretches.push_back({r, 0, n});
      continue;
    }
    for (int first = 0; first + 1 < n; first += samples, ++number)
      if (number % every == 0) stretches.push_back({r, first, std::min(n, first + samples)});
  }
  return stretches;
}

void NoiseFit::add_wander(bool of_headings) {
  free.push_back(noise_size::wander);
  if (of_headings) free.push_back(noise_size::heading_wander);
}

void NoiseFit::add_body() {
  free.insert(free.end(), {noise_size::along, noise_size::turning, noise_size::sideways});
  usual_of_body = 0.1;
  least_sideways = 0.02;
}

namespace {

constexpr double kShare = 0.3;  // of the wheels' noise, to start from

bool is_of_the_body(int size) {
  return size == noise_size::along || size == noise_size::turning || size == noise_size::sideways;
}

}  // namespace

FittedNoise with_body(FittedNoise noise) {
  if (noise.along_m_per_sqrt_m <= 0.0)
    noise.along_m_per_sqrt_m = noise.turning_m_per_sqrt_m = noise.sideways_m_per_sqrt_m =
        kShare * noise.wheel_m_per_sqrt_m;
  return noise;
}

FittedNoise with_wander(FittedNoise noise) {
  constexpr double kWalking_mps = 1.0, kBase_m = 1.0;
  const double start = kShare * noise.wheel_m_per_sqrt_m * std::sqrt(kWalking_mps);
  noise.wander_m_per_sqrt_s = std::max(noise.wander_m_per_sqrt_s, start);
  noise.heading_wander_rad_per_sqrt_s = std::max(noise.heading_wander_rad_per_sqrt_s, start / kBase_m);
  return noise;
}

FittedNoise with_timing(FittedNoise noise) {
  if (noise.command_timing_s <= 0.0) noise.command_timing_s = kUsualNoise.command_timing_s;
  return noise;
}

FittedNoise most_likely_noise(const std::function<NoiseSlopes(const FittedNoise&)>& likelihood, FittedNoise start,
                              const NoiseFit& fit) {
  constexpr double kLeastCurvature = 1e-6;
  const std::size_t n = fit.free.size();
  FittedNoise usual = fit.usual;
  const auto is_free = [&](int size) { return std::find(fit.free.begin(), fit.free.end(), size) != fit.free.end(); };
  // The noise of these logarithms within its bounds, and these with it.
  const auto bounded = [&](std::vector<double>& logs) {
    FittedNoise noise = start;
    for (std::size_t k = 0; k < n; ++k) size_of(noise, fit.free[k]) = std::exp(logs[k]);
    noise = as_large_as_any_real(noise);
    noise.sideways_m_per_sqrt_m = std::max(noise.sideways_m_per_sqrt_m, fit.least_sideways * noise.wheel_m_per_sqrt_m);
    for (std::size_t k = 0; k < n; ++k) logs[k] = std::log(size_of(noise, fit.free[k]));
    return noise;
  };
  const auto valued = [&](std::vector<double>& logs) {
    const FittedNoise noise = bounded(logs);
    NoiseSlopes sums = likelihood(noise);
    // Priors.
    std::array<double, noise_size::count> slope = sums.slope;
    for (int size : fit.free) {
      const bool goes_with_wheels = is_of_the_body(size) && fit.usual_of_body > 0.0;
      FittedNoise copy = noise;
      const double at_rest = goes_with_wheels ? fit.usual_of_body * noise.wheel_m_per_sqrt_m : size_of(usual, size);
      const double within =
          size == noise_size::position || size == noise_size::heading ? fit.within_of_truth : fit.within;
      const double off = std::log(size_of(copy, size) / at_rest) / within;
      sums.value += off * off;
      const auto curve = [&](int a, int b, double by) {
        sums.curvature[static_cast<std::size_t>(noise_size::count * a + b)] += by * 2.0 / (within * within);
      };
      const auto pull = [&](int a, double by) { slope[static_cast<std::size_t>(a)] += by * 2.0 * off / within; };
      pull(size, 1.0);
      curve(size, size, 1.0);
      if (!goes_with_wheels) continue;
      pull(noise_size::wheel, -1.0);
      curve(noise_size::wheel, noise_size::wheel, 1.0);
      curve(noise_size::wheel, size, -1.0);
      curve(size, noise_size::wheel, -1.0);
    }
    // What lies at its bound and would go beyond stays there; sideways it then goes with the wheels.
    constexpr double kAtBound = 1.0 + 1e-9;
    std::array<int, noise_size::count> moves_with{};
    for (int size = 0; size < noise_size::count; ++size) {
      FittedNoise copy = noise, least = as_large_as_any_real({});
      const double bound =
          size == noise_size::sideways ? fit.least_sideways * noise.wheel_m_per_sqrt_m : size_of(least, size);
      const bool held = !is_free(size) || (size_of(copy, size) <= bound * kAtBound && slope[size] > 0.0);
      moves_with[size] = held ? -1 : size;
    }
    if (is_free(noise_size::sideways) && moves_with[noise_size::sideways] < 0)
      moves_with[noise_size::sideways] = moves_with[noise_size::wheel];
    Sloped out;
    out.value = sums.value;
    out.slope.assign(n, 0.0);
    out.curvature.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (int a = 0; a < noise_size::count; ++a) {
        if (moves_with[a] != fit.free[i]) continue;
        out.slope[i] += slope[a];
        for (std::size_t j = 0; j < n; ++j)
          for (int b = 0; b < noise_size::count; ++b)
            if (moves_with[b] == fit.free[j]) out.curvature[i * n + j] += sums.curvature[noise_size::count * a + b];
      }
    for (std::size_t i = 0; i < n; ++i)  // what is held
      if (out.curvature[i * n + i] < kLeastCurvature) out.curvature[i * n + i] = 1.0;
    return out;
  };
  std::vector<double> logs;
  for (int size : fit.free) logs.push_back(std::log(size_of(start, size)));
  std::vector<double> best = descended(valued, logs);
  return bounded(best);
}

}  // namespace odolab
