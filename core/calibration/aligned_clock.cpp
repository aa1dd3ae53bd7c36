#include "core/calibration/aligned_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/calibration/wheels_at.h"

namespace odolab {

namespace {

constexpr double kStep_s = 0.01;      // from one lag to the next
constexpr int kLags = 50;             // to each side
constexpr int kMostLags = 200;        // where the best lie at the end
constexpr double kSpan_s = 0.1;       // of what is compared: short beside the turns of a path, long beside rounding
constexpr double kWindow_s = 8.0;     // in which a lag is taken as constant
constexpr double kSparsest_s = 0.25;  // truth, from sample to sample
constexpr std::size_t kFewestIncrements = 20;  // increments in a window

// What the wheels add up to, on an even grid.
struct SummedWay {
  double start_s = 0.0;
  std::vector<double> forward_m, turn_rad;
};

SummedWay way_of(const InnovationRun& run, const DifferentialDrive& drive) {
  SummedWay way;
  way.start_s = run.wheels.front().time_s;
  const auto n = static_cast<std::size_t>((run.wheels.back().time_s - way.start_s) / kStep_s) + 1;
  for (std::size_t k = 0; k < n; ++k) {
    const WheelSample now = wheels_at(run.wheels, way.start_s + static_cast<double>(k) * kStep_s);
    const double left = drive.wheel_radius_left_m * now.left_rad, right = drive.wheel_radius_right_m * now.right_rad;
    way.forward_m.push_back(0.5 * (left + right));
    way.turn_rad.push_back((right - left) / drive.wheelbase_m);
  }
  return way;
}

struct GridPlace {
  std::ptrdiff_t at = 0;
  double share = 0.0;  // of the way to the next
};

// One of the truth's increments: what it was, and where its ends lie on the grid at a lag of zero.
struct Increment {
  double forward_m, turn_rad;
  GridPlace from, to;
};

// A stretch of the run.
struct Window {
  double share = 0.0;        // of the run before its middle
  std::vector<double> chi2;  // at each lag, as many to either side

  double at(double lag) const {
    const double middle = 0.5 * static_cast<double>(chi2.size() - 1);
    const double k = std::clamp(lag + middle, 0.0, 2.0 * middle - 1e-9);
    const auto below = static_cast<std::size_t>(k);
    return chi2[below] + (k - static_cast<double>(below)) * (chi2[below + 1] - chi2[below]);
  }
};

double along(const std::vector<double>& of, const GridPlace& place, int later) {
  const std::ptrdiff_t at = place.at - later;
  if (at < 0) return of.front();
  if (at + 1 >= static_cast<std::ptrdiff_t>(of.size())) return of.back();
  const auto k = static_cast<std::size_t>(at);
  return of[k] + place.share * (of[k + 1] - of[k]);
}

// Their scatter about the mean, which is what another radius or wheelbase would take.
double chi2_at(const std::vector<Increment>& increments, const SummedWay& way, int later, double per_m2,
               double per_rad2) {
  double sum[2] = {}, square[2] = {};
  for (const Increment& i : increments) {
    const double f = i.forward_m - (along(way.forward_m, i.to, later) - along(way.forward_m, i.from, later));
    const double w = i.turn_rad - (along(way.turn_rad, i.to, later) - along(way.turn_rad, i.from, later));
    sum[0] += f, sum[1] += w;
    square[0] += f * f, square[1] += w * w;
  }
  const double n = static_cast<double>(increments.size());
  return (square[0] - sum[0] * sum[0] / n) * per_m2 + (square[1] - sum[1] * sum[1] / n) * per_rad2;
}

}  // namespace

std::optional<AlignedClock> aligned_clock(const InnovationRun& run, const InnovationModel& model) {
  const std::vector<TruthSample>& truth = run.truth;
  if (!run.truth_has_heading || truth.size() < kFewestIncrements || run.wheels.size() < kFewestIncrements)
    return std::nullopt;
  const double duration_s = truth.back().time_s - truth.front().time_s;
  const double period_s = duration_s / static_cast<double>(truth.size() - 1);
  const double p = model.noise.truth_position_m, h = model.noise.truth_heading_rad;
  if (period_s > kSparsest_s || p <= 0.0 || h <= 0.0) return std::nullopt;
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(kSpan_s / period_s)));
  const SummedWay way = way_of(run, model.drive);
  if (way.forward_m.size() < 2) return std::nullopt;

  const auto windows = static_cast<std::size_t>(std::max(2.0, std::round(duration_s / kWindow_s)));
  std::vector<std::vector<Increment>> of(windows);
  const Pose back = inverse(model.truth.axle_T_tracked);
  std::size_t whole_from = 0;  // the samples from here on are all there
  for (std::size_t j = 0; j < truth.size(); ++j) {
    if (run.set_aside[j] || !truth[j].heading_rad) {
      whole_from = j + 1;
      continue;
    }
    if (is_cut(run, j)) whole_from = j;
    if (j < whole_from + stride) continue;
    const auto axle = [&](const TruthSample& t) { return Pose{t.position.x_m, t.position.y_m, *t.heading_rad} * back; };
    const TruthSample &a = truth[j - stride], &b = truth[j];
    const Pose by = between(axle(a), axle(b));
    const double middle = 0.5 * by.heading_rad;
    Increment i{by.x_m * std::cos(middle) + by.y_m * std::sin(middle), by.heading_rad, {}, {}};
    for (const auto& [end, time_s] : {std::pair{&i.from, a.time_s}, {&i.to, b.time_s}}) {
      const double k = (time_s - model.truth.time_offset_s - way.start_s) / kStep_s;
      *end = {static_cast<std::ptrdiff_t>(std::floor(k)), k - std::floor(k)};
    }
    const double share = (a.time_s - truth.front().time_s) / duration_s;
    of[std::min(windows - 1, static_cast<std::size_t>(share * static_cast<double>(windows)))].push_back(i);
  }

  // Each increment holds the errors of two samples, each sample is in two increments for every stride.
  const double per_m2 = 1.0 / (2.0 * p * p * static_cast<double>(stride)),
               per_rad2 = 1.0 / (2.0 * h * h * static_cast<double>(stride));
  int best_first = 0, best_last = 0;
  double gain = 0.0;
  for (int lags = kLags; lags <= kMostLags; lags *= 2) {
    std::vector<Window> lagged;
    for (std::size_t w = 0; w < windows; ++w) {
      if (of[w].size() < kFewestIncrements) continue;
      Window window{(static_cast<double>(w) + 0.5) / static_cast<double>(windows), {}};
      for (int lag = -lags; lag <= lags; ++lag) window.chi2.push_back(chi2_at(of[w], way, lag, per_m2, per_rad2));
      lagged.push_back(std::move(window));
    }
    if (lagged.size() < 2) return std::nullopt;

    const auto total = [&](int first, int last) {
      double sum = 0.0;
      for (const Window& w : lagged) sum += w.at(first + w.share * (last - first));
      return sum;
    };
    const double as_they_are = total(0, 0);
    double best = as_they_are;
    for (int first = -lags; first <= lags; ++first)
      for (int last = -lags; last <= lags; ++last) {
        const double chi2 = total(first, last);
        if (chi2 < best) best = chi2, best_first = first, best_last = last;
      }
    gain = as_they_are - best;
    if (std::max(std::abs(best_first), std::abs(best_last)) < lags) break;
  }
  return AlignedClock{model.truth.time_offset_s + best_first * kStep_s, (best_first - best_last) * kStep_s / duration_s,
                      gain};
}

std::vector<std::optional<AlignedClock>> aligned_clocks(const std::vector<InnovationRun>& runs,
                                                        const std::function<InnovationModel(int run)>& model_of) {
  std::vector<std::optional<AlignedClock>> clocks(runs.size());
  parallel_for(static_cast<int>(runs.size()), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    clocks[r] = aligned_clock(runs[r], model_of(run));
  });
  return clocks;
}

bool worth_a_try(const std::vector<std::optional<AlignedClock>>& clocks) {
  constexpr double kWorthATry = 50.0;  // of chi-square: samples taken as independent, which they are not
  return std::any_of(clocks.begin(), clocks.end(),
                     [](const std::optional<AlignedClock>& clock) { return clock && clock->gain >= kWorthATry; });
}

std::optional<std::vector<AlignedClock>> moved_clocks(const std::vector<InnovationRun>& runs,
                                                      const std::function<InnovationModel(int run)>& model_of) {
  const std::vector<std::optional<AlignedClock>> found = aligned_clocks(runs, model_of);
  if (!worth_a_try(found)) return std::nullopt;
  std::vector<AlignedClock> clocks;
  for (std::size_t r = 0; r < found.size(); ++r)
    clocks.push_back(found[r].value_or(AlignedClock{model_of(static_cast<int>(r)).truth.time_offset_s}));
  return clocks;
}

}  // namespace odolab
