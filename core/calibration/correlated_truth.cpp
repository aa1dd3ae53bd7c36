#include "core/calibration/correlated_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/quantile.h"
#include "core/base/stamp_digits.h"
#include "core/geometry/angles.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

// Products of neighbouring samples' deviations, and their squares.
struct Neighbours {
  double products = 0.0, squares = 0.0, count = 0.0;

  // The samples of one rest. An outlier counts as little as the farthest of the rest.
  void add(std::vector<double> values) {
    constexpr std::size_t kFewest = 4;
    constexpr double kFarthest = 4.0;  // in standard deviations
    if (values.size() < kFewest) return;
    const double middle = median(values);
    for (double& v : values) v -= middle;
    const double most = kFarthest * scatter_about_zero(values);
    double mean = 0.0;
    for (double& v : values) mean += v = std::clamp(v, -most, most);
    const auto n = static_cast<double>(values.size());
    mean /= n;
    double square = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      square += (values[i] - mean) * (values[i] - mean);
      if (i > 0) products += (values[i] - mean) * (values[i - 1] - mean);
    }
    squares += square;
    products += square / n;  // which the mean takes of them
    count += n;
  }
  bool tells() const {
    constexpr double kEnough = 50.0;  // a standard error of 0.14
    return count >= kEnough && squares > 0.0;
  }
  double correlation() const { return products / squares; }
};

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

Recording with_truth_apart(const Recording& recording, double apart_s) {
  Recording out = recording;
  const Channel* x = recording.channel("truth_x_m");
  if (!x) return out;
  double next_s = -std::numeric_limits<double>::infinity();
  std::vector<char> dropped(recording.time_s.size(), 0);
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (std::isnan(x->values[i])) continue;
    if (recording.time_s[i] < next_s)
      dropped[i] = 1;
    else
      next_s = recording.time_s[i] + apart_s - kStampDigits_s;
  }
  leave_truth_out(out, dropped);
  return out;
}

std::optional<double> correlation_at_rest(const std::vector<Recording>& recordings, const DifferentialDrive& drive,
                                          double truth_late_s, bool by_commands) {
  Neighbours positions, headings;
  for (const Recording& recording : recordings) {
    const std::vector<TruthSample> truth = truth_samples(recording);
    for (const auto& [from_s, to_s] : long_rests(wheel_samples(recording, drive), !by_commands)) {
      std::vector<double> x_m, y_m, heading_rad;
      for (const TruthSample& t : truth) {
        if (t.time_s - truth_late_s < from_s || t.time_s - truth_late_s > to_s) continue;
        x_m.push_back(t.position.x_m);
        y_m.push_back(t.position.y_m);
        if (t.heading_rad)
          heading_rad.push_back(heading_rad.empty() ? *t.heading_rad : unwrapped(*t.heading_rad, heading_rad.back()));
      }
      positions.add(std::move(x_m));
      positions.add(std::move(y_m));
      headings.add(std::move(heading_rad));
    }
  }
  if (!positions.tells() || (headings.count > 0.0 && !headings.tells())) return std::nullopt;
  return headings.tells() ? std::max(positions.correlation(), headings.correlation()) : positions.correlation();
}

}  // namespace odolab
