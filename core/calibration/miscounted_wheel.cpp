#include "core/calibration/miscounted_wheel.h"

#include <algorithm>
#include <cmath>

#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

constexpr const char* kRadius = "wheel_radius_";

struct SizeInWords {
  double times;
  const char *as_large, *counts;
};
constexpr SizeInWords kTimes[] = {{2.0, "twice", "half of"},
                                  {4.0, "four times", "a quarter of"},
                                  {0.5, "half", "twice"},
                                  {0.25, "a quarter", "four times"}};

const SizeInWords& words_of(double times) {
  return *std::find_if(std::begin(kTimes), std::end(kTimes), [&](const SizeInWords& t) { return t.times == times; });
}

}  // namespace

std::vector<MiscountedWheel> miscounted_wheels(const LeastSquaresCalibration& calibration) {
  constexpr double kAlike = 0.02, kOrdinary = 0.2;  // of a wheel that is counted as the file says
  std::vector<MiscountedWheel> wheels;
  if (calibration.scale_is_open) return wheels;
  const std::vector<ParameterEstimate>& all = calibration.parameters;
  for (const ParameterEstimate& p : all) {
    const std::size_t at = p.name.find(kRadius);
    if (at == std::string::npos || !p.determined || !(p.nominal > 0.0)) continue;
    const std::string of = p.name.substr(0, at);
    const bool left = p.name == of + kRadius + "left_m";
    const std::string other = of + kRadius + (left ? "right_m" : "left_m");
    const auto beside =
        std::find_if(all.begin(), all.end(), [&](const ParameterEstimate& q) { return q.name == other; });
    if (beside == all.end() || !beside->determined || std::abs(beside->value / beside->nominal - 1.0) > kOrdinary)
      continue;
    for (const SizeInWords& t : kTimes)
      if (std::abs(p.value / (t.times * p.nominal) - 1.0) < kAlike)
        wheels.push_back({p.name, of + (left ? "left_wheel" : "right_wheel"), t.times});
  }
  return wheels;
}

std::string counts_in_words(const MiscountedWheel& wheel) {
  return std::string("its encoder counts ") + words_of(wheel.times).counts +
         " what the file says (one channel, or other settings of one side)";
}

std::string in_words(const MiscountedWheel& wheel) {
  std::string which = component_words(wheel.component);
  which.front() = 'T';  // "the right wheel"
  return which + " seems " + words_of(wheel.times).as_large + " as large as the file says: " + counts_in_words(wheel);
}

}  // namespace odolab
