#include "core/calibration/left_out.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/restamped.h"

namespace odolab {

namespace {

double interval_s(const std::vector<WheelSample>& readings, std::size_t i) {
  return readings[i + 1].time_s - readings[i].time_s;
}

// How long beyond its end the wheels may be taken to go on as in that interval: until they turn so far that it would
// show, but a tenth of the usual interval at least and all of it at most.
double reach_s(const std::vector<WheelSample>& readings, std::size_t interval, double usual_s) {
  constexpr double kUnseen_rad = 1e-3, kLeastShare = 0.1;
  const WheelSample &a = readings[interval], &b = readings[interval + 1];
  const double turned_rad = std::max(std::abs(b.left_rad - a.left_rad), std::abs(b.right_rad - a.right_rad));
  const double least_s = kLeastShare * usual_s;
  if (turned_rad * usual_s <= kUnseen_rad * interval_s(readings, interval)) return usual_s + 1e-9;
  return std::clamp(kUnseen_rad * interval_s(readings, interval) / turned_rad, least_s, usual_s);
}

// Moves the readings behind the interval so that the wheel turns in it as it did around it, if it turned faster there
// than ever.
void take_back(std::vector<WheelSample>& readings, double WheelSample::*wheel, std::size_t interval,
               double fastest_radps, double count_rad) {
  const auto by = [&](std::size_t i) { return readings[i + 1].*wheel - readings[i].*wheel; };
  const double span_s = interval_s(readings, interval);
  if (std::abs(by(interval)) <= 2.0 * fastest_radps * span_s + 2.0 * count_rad) return;
  double around_radps = 0.0;
  int known = 0;
  if (interval > 0) around_radps += by(interval - 1) / interval_s(readings, interval - 1), ++known;
  if (interval + 2 < readings.size()) around_radps += by(interval + 1) / interval_s(readings, interval + 1), ++known;
  const double expected_rad = known > 0 ? around_radps / known * span_s : 0.0;
  double jump_rad = by(interval) - expected_rad;
  if (count_rad > 0.0) jump_rad = count_rad * std::round(jump_rad / count_rad);
  for (std::size_t i = interval + 1; i < readings.size(); ++i) readings[i].*wheel -= jump_rad;
}

double fastest_radps(const std::vector<WheelSample>& readings, double WheelSample::*wheel) {
  constexpr double kUsual = 0.97;
  std::vector<double> rates;
  for (std::size_t i = 0; i + 1 < readings.size(); ++i)
    rates.push_back(std::abs(readings[i + 1].*wheel - readings[i].*wheel) / interval_s(readings, i));
  return quantile(std::move(rates), kUsual);
}

}  // namespace

std::vector<std::size_t> long_intervals(const std::vector<WheelSample>& readings, double times_usual) {
  constexpr double kLeast_s = 0.2;
  constexpr std::size_t kFewest = 20;
  if (readings.size() < kFewest) return {};
  std::vector<double> lasts_s;
  for (std::size_t i = 0; i + 1 < readings.size(); ++i) lasts_s.push_back(interval_s(readings, i));
  const double longest_s = std::max(kLeast_s, times_usual * quantile(lasts_s, 0.5));
  std::vector<std::size_t> intervals;
  for (std::size_t i = 0; i < lasts_s.size(); ++i)
    if (lasts_s[i] > longest_s) intervals.push_back(i);
  return intervals;
}

TimeStretches encoder_gaps(const std::vector<WheelSample>& readings) {
  constexpr double kUsualStep = 0.95, kTimesUsual = 2.5;
  const std::vector<std::size_t> intervals = long_intervals(readings, kTimesUsual);
  if (intervals.empty()) return {};
  std::vector<double> turned_rad;
  for (std::size_t i = 0; i + 1 < readings.size(); ++i) {
    const WheelSample &a = readings[i], &b = readings[i + 1];
    turned_rad.push_back(std::max(std::abs(b.left_rad - a.left_rad), std::abs(b.right_rad - a.right_rad)));
  }
  const double step_rad = quantile(turned_rad, kUsualStep);
  TimeStretches gaps;
  for (const std::size_t i : intervals)
    if (turned_rad[i] > step_rad) gaps.emplace_back(readings[i].time_s, readings[i + 1].time_s);
  return gaps;
}

TimeStretches joined(TimeStretches stretches) {
  std::sort(stretches.begin(), stretches.end());
  TimeStretches all;
  for (const auto& [from_s, to_s] : stretches)
    if (!all.empty() && from_s <= all.back().second)
      all.back().second = std::max(all.back().second, to_s);
    else
      all.emplace_back(from_s, to_s);
  return all;
}

std::vector<WheelSample> bridged(std::vector<WheelSample> readings, const TimeStretches& left_out, double count_rad) {
  if (left_out.empty()) return readings;
  const auto within = [&](const WheelSample& w) {
    return std::any_of(left_out.begin(), left_out.end(),
                       [&](const auto& s) { return w.time_s > s.first && w.time_s < s.second; });
  };
  readings.erase(std::remove_if(readings.begin(), readings.end(), within), readings.end());
  if (readings.size() < 2) return readings;
  const double left_radps = fastest_radps(readings, &WheelSample::left_rad);
  const double right_radps = fastest_radps(readings, &WheelSample::right_rad);
  for (std::size_t i = 0; i + 1 < readings.size(); ++i) {
    const auto bridges = [&](const auto& s) {
      return s.first <= readings[i].time_s && readings[i + 1].time_s <= s.second;
    };
    if (!std::any_of(left_out.begin(), left_out.end(), bridges)) continue;
    take_back(readings, &WheelSample::left_rad, i, left_radps, count_rad);
    take_back(readings, &WheelSample::right_rad, i, right_radps, count_rad);
  }
  return readings;
}

bool leaves_out(const InnovationRun& run, double from_s, double to_s) {
  const auto behind = std::upper_bound(run.left_out.begin(), run.left_out.end(), from_s,
                                       [](double t, const auto& stretch) { return t < stretch.second; });
  return behind != run.left_out.end() && behind->first < to_s;
}

void cut_where_left_out(InnovationRun& run, double offset_s, double rate) {
  const std::vector<WheelSample>& wheels = run.wheels;
  const double usual_s = (wheels.back().time_s - wheels.front().time_s) / static_cast<double>(wheels.size() - 1);
  const double from_s = wheels.front().time_s - reach_s(wheels, 0, usual_s);
  const double to_s = wheels.back().time_s + reach_s(wheels, wheels.size() - 2, usual_s);
  run.cut.assign(run.truth.size(), 0);
  const TwoClocks clocks{run.truth.empty() ? 0.0 : run.truth.front().time_s, offset_s, rate};
  const auto wheels_s = [&](std::size_t k) { return clocks.wheels_stamp_s(run.truth[k].time_s); };
  for (std::size_t k = 1; k < run.truth.size(); ++k) {
    const double before_s = wheels_s(k - 1), here_s = wheels_s(k);
    if (before_s < from_s || here_s > to_s || leaves_out(run, before_s, here_s)) run.cut[k] = 1;
  }
}

}  // namespace odolab
