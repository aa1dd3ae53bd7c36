#include "core/calibration/frozen_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/odometry/differential_drive.h"

namespace odolab {

double least_step_m(const std::vector<TruthSample>& truth) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Vec2 by = truth[i].position - truth[i - 1].position;
    for (const double step_m : {std::abs(by.x_m), std::abs(by.y_m)})
      if (step_m > 1e-9) least_m = std::min(least_m, step_m);
  }
  return least_m;
}

TimeStretches frozen_truth(const std::vector<TruthSample>& truth, const std::vector<WheelSample>& wheels,
                           const DifferentialDrive& drive, double truth_late_s) {
  // Where no headings are measured, what turns on the spot may stay where it is.
  const bool has_headings = std::any_of(
      truth.begin(), truth.end(), [&](const TruthSample& t) { return t.heading_rad != truth.front().heading_rad; });
  std::vector<double> rolled_m{0.0};
  for (std::size_t i = 1; i < wheels.size(); ++i) {
    const double left_m = drive.wheel_radius_left_m * (wheels[i].left_rad - wheels[i - 1].left_rad),
                 right_m = drive.wheel_radius_right_m * (wheels[i].right_rad - wheels[i - 1].right_rad);
    rolled_m.push_back(rolled_m.back() + 0.5 * (std::abs(left_m) + std::abs(right_m)));
  }
  const Track track = dead_reckoned(wheels, drive, Pose{});
  // By the readings between the stamps alone: a wheel may set off just behind the last one.
  const auto moved_between = [&](double from_s, double to_s) {
    const auto earlier = [](const WheelSample& w, double t) { return w.time_s < t; };
    const auto from =
                   std::lower_bound(wheels.begin(), wheels.end() - 1, from_s - truth_late_s, earlier) - wheels.begin(),
               behind =
                   std::lower_bound(wheels.begin(), wheels.end() - 1, to_s - truth_late_s, earlier) - wheels.begin();
    const auto to = std::max(from, behind - 1);
    const auto begin = static_cast<std::size_t>(from), end = static_cast<std::size_t>(to);
    const Pose &was = track[begin].pose, &is = track[end].pose;
    return has_headings ? rolled_m[end] - rolled_m[begin] : std::hypot(is.x_m - was.x_m, is.y_m - was.y_m);
  };
  // Of a truth that is rounded, poses within one step of it are the same.
  constexpr double kCoarsest_m = 0.01;
  const double least_rolled_m = std::max(0.005, 2.0 * std::min(kCoarsest_m, least_step_m(truth)));
  TimeStretches repeated;
  double shortest_s = std::numeric_limits<double>::infinity();  // of those on the way
  for (std::size_t i = 0; i < truth.size();) {
    std::size_t j = i + 1;
    while (j < truth.size() && truth[j].position.x_m == truth[i].position.x_m &&
           truth[j].position.y_m == truth[i].position.y_m && truth[j].heading_rad == truth[i].heading_rad)
      ++j;
    if (j - i >= 3) {
      repeated.push_back({truth[i].time_s, truth[j - 1].time_s});
      if (moved_between(truth[i].time_s, truth[j - 1].time_s) > least_rolled_m)
        shortest_s = std::min(shortest_s, truth[j - 1].time_s - truth[i].time_s);
    }
    i = j;
  }
  // What lasts far shorter is a slow vehicle's within one step of a rounded truth.
  std::erase_if(repeated, [&](const auto& t) { return t.second - t.first < 0.5 * shortest_s; });
  return repeated;
}

std::string in_words_of_frozen(std::size_t times) {
  return "the truth repeats itself with new stamps while the wheels turn, " + std::to_string(times) +
         " time(s); left out";
}

}  // namespace odolab
