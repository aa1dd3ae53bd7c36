#include "core/calibration/frozen_truth.h"

#include <algorithm>
#include <cmath>

namespace odolab {

TimeStretches frozen_truth(const std::vector<TruthSample>& truth, const std::vector<WheelSample>& wheels,
                           const DifferentialDrive& drive, double truth_late_s) {
  std::vector<double> rolled_m{0.0};
  for (std::size_t i = 1; i < wheels.size(); ++i)
    rolled_m.push_back(rolled_m.back() +
                       0.5 * drive.wheel_radius_left_m * std::abs(wheels[i].left_rad - wheels[i - 1].left_rad) +
                       0.5 * drive.wheel_radius_right_m * std::abs(wheels[i].right_rad - wheels[i - 1].right_rad));
  const auto rolled_by = [&](double truth_stamp_s) {
    const auto it = std::lower_bound(wheels.begin(), wheels.end() - 1, truth_stamp_s - truth_late_s,
                                     [](const WheelSample& w, double t) { return w.time_s < t; });
    return rolled_m[static_cast<std::size_t>(it - wheels.begin())];
  };
  // Of a truth that is rounded, poses within one step of it are the same.
  double step_m = 0.01;
  for (std::size_t i = 1; i < truth.size(); ++i)
    if (const double by = std::abs(truth[i].position.x_m - truth[i - 1].position.x_m); by > 0.0)
      step_m = std::min(step_m, by);
  const double least_rolled_m = std::max(0.005, 2.0 * step_m);
  TimeStretches repeated;
  bool on_the_way = false;
  for (std::size_t i = 0; i < truth.size();) {
    std::size_t j = i + 1;
    while (j < truth.size() && truth[j].position.x_m == truth[i].position.x_m &&
           truth[j].position.y_m == truth[i].position.y_m && truth[j].heading_rad == truth[i].heading_rad)
      ++j;
    if (j - i >= 3) {
      repeated.push_back({truth[i].time_s, truth[j - 1].time_s});
      on_the_way = on_the_way || rolled_by(truth[j - 1].time_s) - rolled_by(truth[i].time_s) > least_rolled_m;
    }
    i = j;
  }
  return on_the_way ? repeated : TimeStretches{};
}

std::string in_words_of_frozen(std::size_t times) {
  return "the truth repeats itself with new stamps while the wheels turn, " + std::to_string(times) +
         " time(s); left out";
}

}  // namespace odolab
