#include "core/calibration/between_readings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"

namespace odolab {

namespace {

// What a cubic misses of each reading whose neighbours, and theirs, are as far apart; next to the ends, where there are
// too few, what a straight line does. Of whole counts none.
std::vector<double> missed_rad(const std::vector<WheelSample>& wheels, double WheelSample::*wheel, double count) {
  constexpr double kOfCounts = 1.5;
  const std::size_t n = wheels.size();
  std::vector<double> missed(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double beside = wheels[i - 1].*wheel + wheels[i + 1].*wheel;
    const bool is_inside = i >= 3 && i + 3 < n;
    const double by_others =
        is_inside ? (9.0 * beside - wheels[i - 3].*wheel - wheels[i + 3].*wheel) / 16.0 : 0.5 * beside;
    missed[i] = std::max(0.0, std::abs(wheels[i].*wheel - by_others) - kOfCounts * count);
  }
  missed.front() = missed[1];
  missed.back() = missed[n - 2];
  return missed;
}

// The noise of a coordinate by second differences, to which a way that bends adds: no more than that.
double noise_at_most_m(const std::vector<TruthSample>& truth) {
  std::vector<double> bends;
  for (std::size_t k = 2; k < truth.size(); ++k) {
    const Vec2 bend = truth[k].position - 2.0 * truth[k - 1].position + truth[k - 2].position;
    bends.push_back(bend.x_m);
    bends.push_back(bend.y_m);
  }
  return scatter_about_zero(std::move(bends)) / std::sqrt(6.0);
}

}  // namespace

bool is_read_seldom(const InnovationRun& run) {
  const std::vector<WheelSample>& wheels = run.wheels;
  return (wheels.back().time_s - wheels.front().time_s) / static_cast<double>(wheels.size() - 1) >= kReadingsFarApart_s;
}

void trust_less_between_readings(InnovationRun& run, const InnovationModel& model) {
  constexpr double kHoles_s = 0.5, kOfMissed = 0.25;
  const std::vector<WheelSample>& wheels = run.wheels;
  if (run.speeds_are_held || wheels.size() < 8 || run.truth.size() < 8) return;
  if (!is_read_seldom(run)) return;
  const double count = run.counts_show ? count_rad(run, model.drive) : 0.0;
  const std::vector<double> left = missed_rad(wheels, &WheelSample::left_rad, count),
                            right = missed_rad(wheels, &WheelSample::right_rad, count);
  const double noise_m = std::min(model.noise.truth_position_m / std::sqrt(run.samples_averaged),
                                  std::max(noise_at_most_m(run.truth), 1e-6)),
               noise_rad = model.noise.truth_heading_rad / std::sqrt(run.samples_averaged);
  if (run.truth_variance.empty()) run.truth_variance.assign(run.truth.size(), 1.0);
  std::size_t i = 0;
  for (std::size_t k = 0; k < run.truth.size(); ++k) {
    const double at_s = run.truth[k].time_s - model.truth.time_offset_s;
    while (i + 2 < wheels.size() && wheels[i + 1].time_s <= at_s) ++i;
    const double gap_s = wheels[i + 1].time_s - wheels[i].time_s, u = (at_s - wheels[i].time_s) / gap_s;
    if (gap_s < kReadingsFarApart_s || gap_s > kHoles_s || u <= 0.0 || u >= 1.0) continue;
    const double share = kOfMissed * 16.0 * u * u * (1.0 - u) * (1.0 - u);
    const double left_m = share * model.drive.wheel_radius_left_m * std::max(left[i], left[i + 1]),
                 right_m = share * model.drive.wheel_radius_right_m * std::max(right[i], right[i + 1]);
    const double ahead = 0.5 * (left_m + right_m) / noise_m,
                 turned = run.truth_has_heading ? (left_m + right_m) / model.drive.wheelbase_m / noise_rad : 0.0;
    run.truth_variance[k] *= 1.0 + std::max(ahead * ahead, turned * turned);
  }
}

}  // namespace odolab
