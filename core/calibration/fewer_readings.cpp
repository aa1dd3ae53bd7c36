#include "core/calibration/fewer_readings.h"

#include <algorithm>

namespace odolab {

namespace {

// The numbers of those that stay. What is left out begins and ends at readings, which stay too.
std::vector<std::size_t> kept_readings(const InnovationRun& run, double longest_s) {
  std::vector<double> ends_s;
  for (const auto& [from_s, to_s] : run.left_out) ends_s.push_back(from_s), ends_s.push_back(to_s);
  std::sort(ends_s.begin(), ends_s.end());
  const std::vector<WheelSample>& wheels = run.wheels;
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i < wheels.size(); ++i)
    if (i + 1 == wheels.size() || wheels[i + 1].time_s - wheels[kept.back()].time_s > longest_s ||
        std::binary_search(ends_s.begin(), ends_s.end(), wheels[i].time_s))
      kept.push_back(i);
  return kept;
}

// Over several intervals, each as long as it lasts.
WheelAcceleration mean_acceleration(const InnovationRun& run, std::size_t first, std::size_t end) {
  WheelAcceleration mean;
  const double lasts_s = run.wheels[end].time_s - run.wheels[first].time_s;
  for (std::size_t i = first; i < end; ++i) {
    const double share = (run.wheels[i + 1].time_s - run.wheels[i].time_s) / lasts_s;
    const WheelAcceleration& a = run.accelerations[i];
    mean.left_radps2 += share * a.left_radps2;
    mean.right_radps2 += share * a.right_radps2;
    mean.left_steady_radps2 += share * a.left_steady_radps2;
    mean.right_steady_radps2 += share * a.right_steady_radps2;
  }
  return mean;
}

}  // namespace

InnovationRun with_fewer_readings(const InnovationRun& run, double longest_s) {
  if (run.speeds_are_held) return run;
  const std::vector<std::size_t> kept = kept_readings(run, longest_s);
  if (kept.size() == run.wheels.size()) return run;
  InnovationRun out = run;
  const auto only_kept = [&](const std::vector<WheelSample>& all) {
    std::vector<WheelSample> some;
    if (!all.empty())
      for (const std::size_t i : kept) some.push_back(all[i]);
    return some;
  };
  out.wheels = only_kept(run.wheels);
  out.smooth = only_kept(run.smooth);
  out.accelerations.clear();
  out.settles.clear();
  for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
    if (!run.accelerations.empty()) out.accelerations.push_back(mean_acceleration(run, kept[k], kept[k + 1]));
    if (run.settles.empty()) continue;
    out.settles.push_back(0);
    for (std::size_t i = kept[k]; i < kept[k + 1]; ++i) out.settles.back() |= run.settles[i];
  }
  return out;
}

}  // namespace odolab
