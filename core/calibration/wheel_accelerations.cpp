#include "core/calibration/wheel_accelerations.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/base/stamp_digits.h"
#include "core/calibration/parabola.h"

namespace odolab {

namespace {

constexpr double kShortestWindow_s = 0.4, kLongestWindow_s = 0.8;  // of which the weights leave some two thirds
constexpr double kOfCurve = 1903.0;         // n T^4 times the second derivative's variance, for readings of variance 1
constexpr double kShareOfTremble = 0.001;   // of the accelerations' variance
constexpr std::size_t kFewestReadings = 4;  // readings, two to either side of an interval

std::vector<BothWheels> accelerations_of(const std::vector<WheelSample>& readings, double over_s) {
  const std::size_t n = readings.size();
  std::vector<BothWheels> of(n - 1);
  for (std::size_t i = 0, lo = 0, hi = 1; i + 1 < n; ++i) {
    const double middle_s = 0.5 * (readings[i].time_s + readings[i + 1].time_s);
    const double half_s = 0.5 * over_s + kStampDigits_s;
    while (middle_s - readings[lo].time_s > half_s) ++lo;
    while (hi + 1 < n && readings[hi + 1].time_s - middle_s <= half_s) ++hi;
    const std::size_t from = std::min(lo, i >= 1 ? i - 1 : i);
    const std::size_t to = std::max(hi, std::min(i + 2, n - 1));
    if (to - from + 1 < kFewestReadings) continue;
    Parabola p;
    const double reach_s =
        1.05 * std::max({0.5 * over_s, middle_s - readings[from].time_s, readings[to].time_s - middle_s});
    const double a_reach = 1.0 / reach_s;
    for (std::size_t k = from; k <= to; ++k) {
      const double away_s = readings[k].time_s - middle_s, u = away_s * a_reach, w = 1.0 - u * u;
      p.add(away_s, {readings[k].left_rad - readings[i].left_rad, readings[k].right_rad - readings[i].right_rad},
            w * w);
    }
    const BothWheels by = p.second_derivative();
    if (std::isfinite(by.left)) of[i] = by;  // stamps may all be the same
  }
  return of;
}

// Variance of what a reading trembles by, from third differences, to which smooth motion adds nothing; of the middle
// one of those where the wheel moves: a wheel that starts is no tremble.
double tremble_of(const std::vector<WheelSample>& readings, double WheelSample::*wheel) {
  constexpr double kOfOne = 20.0;        // a third difference's variance for a reading's of one: 1 + 9 + 9 + 1
  constexpr double kMiddle = 0.4549364;  // median of a squared standard normal number
  std::vector<double> squares;
  for (std::size_t i = 0; i + 3 < readings.size(); ++i) {
    if (readings[i].*wheel == readings[i + 3].*wheel) continue;
    const double third =
        readings[i + 3].*wheel - 3.0 * readings[i + 2].*wheel + 3.0 * readings[i + 1].*wheel - readings[i].*wheel;
    squares.push_back(third * third);
  }
  return median(std::move(squares)) / kMiddle / kOfOne;
}

// Over how long readings are to be looked at, both wheels together; `steady`: accelerations over the longest.
double window_s(const std::vector<WheelSample>& readings, const std::vector<BothWheels>& steady) {
  const double whole_s = readings.back().time_s - readings.front().time_s;
  const double rate_hz = static_cast<double>(readings.size() - 1) / std::max(whole_s, 1e-9);
  double square = 0.0;
  for (const BothWheels& a : steady) square += a.left * a.left + a.right * a.right;
  square /= static_cast<double>(steady.size());
  if (square == 0.0) return kLongestWindow_s;
  const double tremble = tremble_of(readings, &WheelSample::left_rad) + tremble_of(readings, &WheelSample::right_rad);
  const double needed_s = std::pow(kOfCurve * tremble / (rate_hz * kShareOfTremble * square), 0.2);
  return std::clamp(needed_s, kShortestWindow_s, kLongestWindow_s);
}

}  // namespace

std::vector<WheelAcceleration> wheel_accelerations(const std::vector<WheelSample>& readings) {
  if (readings.size() < kFewestReadings)
    return std::vector<WheelAcceleration>(readings.empty() ? 0 : readings.size() - 1);
  const std::vector<BothWheels> steady = accelerations_of(readings, kLongestWindow_s);
  const double over_s = window_s(readings, steady);
  const std::vector<BothWheels> quick = over_s < kLongestWindow_s ? accelerations_of(readings, over_s) : steady;
  std::vector<WheelAcceleration> of(quick.size());
  for (std::size_t i = 0; i < of.size(); ++i) of[i] = {quick[i].left, quick[i].right, steady[i].left, steady[i].right};
  return of;
}

}  // namespace odolab
