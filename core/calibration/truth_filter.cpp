#include "core/calibration/truth_filter.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/angles.h"
#include "core/recording/new_times.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

constexpr double kUnknownInput = std::numeric_limits<double>::quiet_NaN();

double share_after(double dt_s, double time_constant_s) { return -std::expm1(-dt_s / time_constant_s); }

// Of the samples of one channel: z_i = p_i + a (m_i - p_i), p_i the one before or, with a speed, where that carries it.
std::vector<double> solved_for_input(const std::vector<double>& time_s, const std::vector<double>& filtered,
                                     double time_constant_s, bool has_speed) {
  std::vector<double> measured(filtered.size(), kUnknownInput);
  double speed = 0.0;
  for (std::size_t i = 1; i < filtered.size(); ++i) {
    const double dt_s = time_s[i] - time_s[i - 1];
    if (!(dt_s > 0.0)) continue;
    const double a = share_after(dt_s, time_constant_s), carried = filtered[i - 1] + (has_speed ? speed * dt_s : 0.0);
    const double off = (filtered[i] - carried) / a;
    measured[i] = carried + off;
    // The gain that a Kalman filter of a constant velocity comes to (Kalata 1984, the tracking index).
    speed += (2.0 * (2.0 - a) - 4.0 * std::sqrt(1.0 - a)) / dt_s * off;
  }
  return measured;
}

}  // namespace

double spread_of_measured(const TruthFilter& filter, double dt_s) {
  const double once = 1.0 / share_after(dt_s, filter.time_constant_s);
  return filter.kind == TruthFilter::Kind::low_pass_twice ? once * once : once;
}

Recording unfiltered_truth(const Recording& recording, const TruthFilter& filter) {
  Recording measured = recording;
  NewTimes late{is_of_truth, std::vector<double>(recording.time_s.size(), kUnknownInput)};
  for (Channel& channel : measured.channels) {
    if (!is_of_truth(channel.name)) continue;
    const bool is_angle = channel.name == "truth_heading_rad";
    std::vector<std::size_t> rows;
    std::vector<double> time_s, values;
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (std::isnan(channel.values[i])) continue;
      rows.push_back(i);
      time_s.push_back(recording.time_s[i]);
      values.push_back(is_angle && !values.empty() ? unwrapped(channel.values[i], values.back()) : channel.values[i]);
    }
    std::vector<double> input =
        solved_for_input(time_s, values, filter.time_constant_s, filter.kind == TruthFilter::Kind::constant_velocity);
    if (filter.kind == TruthFilter::Kind::low_pass_twice && input.size() > 1) {
      input.front() = input[1];  // its own past is not known either
      input = solved_for_input(time_s, input, filter.time_constant_s, false);
      input[1] = kUnknownInput;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      channel.values[rows[k]] = input[k];
      if (!std::isnan(input[k])) late.time_s[rows[k]] = recording.time_s[rows[k]] + filter.late_s();
    }
  }
  return with_new_times(measured, {late});
}

}  // namespace odolab
