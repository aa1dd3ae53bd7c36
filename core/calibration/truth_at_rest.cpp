#include "core/calibration/truth_at_rest.h"

#include <algorithm>
#include <utility>

#include "core/geometry/angles.h"

namespace odolab {

namespace {

// Times at which the wheels have rested for a second, and rest still; where they rest as they begin, from then on, if
// `rest_before`.
std::vector<std::pair<double, double>> long_rests(const std::vector<WheelSample>& wheels, bool rest_before) {
  constexpr double kComesToRest_s = 1.0;
  std::vector<std::pair<double, double>> rests;
  for (std::size_t i = 0, since = 0; i < wheels.size(); ++i) {
    const bool moves = wheels[i].left_rad != wheels[since].left_rad || wheels[i].right_rad != wheels[since].right_rad;
    if (!moves && i + 1 < wheels.size()) continue;
    const double from_s = wheels[since].time_s + (since == 0 && rest_before ? 0.0 : kComesToRest_s),
                 to_s = wheels[moves ? i - 1 : i].time_s;
    if (from_s < to_s) rests.emplace_back(from_s, to_s);
    since = i;
  }
  return rests;
}

}  // namespace

std::vector<TruthAtRest> truth_at_rest(const std::vector<Recording>& recordings, const DifferentialDrive& drive,
                                       double truth_late_s, bool by_commands) {
  std::vector<TruthAtRest> rests;
  for (const Recording& recording : recordings) {
    const std::vector<TruthSample> truth = truth_samples(recording);
    for (const auto& [from_s, to_s] : long_rests(wheel_samples(recording, drive), !by_commands)) {
      TruthAtRest rest;
      const auto first = std::partition_point(truth.begin(), truth.end(), [&, from = from_s](const TruthSample& t) {
        return t.time_s - truth_late_s < from;
      });
      for (auto t = first; t != truth.end() && t->time_s - truth_late_s <= to_s; ++t) {
        rest.time_s.push_back(t->time_s);
        rest.x_m.push_back(t->position.x_m);
        rest.y_m.push_back(t->position.y_m);
        if (!t->heading_rad) continue;
        std::vector<double>& h = rest.heading_rad;
        h.push_back(h.empty() ? *t->heading_rad : unwrapped(*t->heading_rad, h.back()));
      }
      rests.push_back(std::move(rest));
    }
  }
  return rests;
}

}  // namespace odolab
