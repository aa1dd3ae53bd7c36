#include "core/calibration/correlated_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/quantile.h"
#include "core/base/stamp_digits.h"
#include "core/calibration/truth_at_rest.h"
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
  for (TruthAtRest& rest : truth_at_rest(recordings, drive, truth_late_s, by_commands)) {
    positions.add(std::move(rest.x_m));
    positions.add(std::move(rest.y_m));
    headings.add(std::move(rest.heading_rad));
  }
  if (!positions.tells() || (headings.count > 0.0 && !headings.tells())) return std::nullopt;
  return headings.tells() ? std::max(positions.correlation(), headings.correlation()) : positions.correlation();
}

}  // namespace odolab
