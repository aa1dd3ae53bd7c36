#include "core/diagnosis/units/joint_shapes.h"

#include <algorithm>
#include <cmath>

namespace odolab {

std::vector<double> mean_readings(const std::vector<UnitSample>& samples, std::size_t joint) {
  constexpr double kAside_s = 0.25;
  std::vector<double> means;
  double sum = 0.0;
  std::size_t first = 0, end = 0;
  for (const UnitSample& s : samples) {
    for (; end < samples.size() && samples[end].time_s <= s.time_s + kAside_s; ++end) sum += samples[end].joints[joint];
    for (; samples[first].time_s < s.time_s - kAside_s; ++first) sum -= samples[first].joints[joint];
    means.push_back(sum / static_cast<double>(end - first));
  }
  return means;
}

void ReadingRange::take_in(const std::vector<UnitSample>& samples, std::size_t joint) {
  for (const double reading : mean_readings(samples, joint))
    low = std::min(low, reading), high = std::max(high, reading);
}

std::vector<double> waves_of_reading(double reading, const ReadingRange& range) {
  const bool around = range.goes_around();
  const double u = range.high > range.low ? (reading - range.low) / (range.high - range.low) : 0.0;
  std::vector<double> s;
  for (int m = 1; m <= kWavesOfReading; ++m) {
    s.push_back(around ? std::cos(m * reading) : std::cos((2 * m - 1) * kPi * u));
    s.push_back(around ? std::sin(m * reading) : std::cos(2 * m * kPi * u));
  }
  return s;
}

std::vector<double> ways_of_reading(const std::vector<UnitSample>& samples, std::size_t joint, double step) {
  std::vector<double> ways;
  double way = 0.0, turned_at = samples.front().joints[joint];
  for (const UnitSample& s : samples) {
    const double reading = s.joints[joint];
    if (way * (reading - turned_at) > 0.0)
      turned_at = reading;
    else if (std::abs(reading - turned_at) > 1.5 * step)
      way = reading > turned_at ? 0.5 : -0.5, turned_at = reading;
    ways.push_back(way);
  }
  return ways;
}

}  // namespace odolab
