#include "core/recording/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/recording/clock_jump.h"

namespace odolab {

namespace {

// Raw counts made continuous across the wrap of a counter of the given width.
std::vector<double> unwrapped_counts(const std::vector<double>& raw, int counter_bits) {
  if (counter_bits <= 0) return raw;
  const double range = std::ldexp(1.0, counter_bits);
  std::vector<double> counts = raw;
  double previous_raw = std::numeric_limits<double>::quiet_NaN(), total = 0.0;
  for (double& count : counts) {
    if (std::isnan(count)) continue;
    total = std::isnan(previous_raw) ? count : total + std::remainder(count - previous_raw, range);
    previous_raw = count;
    count = total;
  }
  return counts;
}

// Whether a channel is there and holds anything.
bool sampled(const Channel* channel) {
  return channel &&
         std::any_of(channel->values.begin(), channel->values.end(), [](double v) { return !std::isnan(v); });
}

// How often one wheel is read, of rows in which the other may be read alone.
struct Readings {
  double usual_s = 0.0;        // from one to the next
  std::vector<char> is_known;  // each row: read, or between two that say how the wheel went from one to the other
};

Readings readings_of(const std::vector<double>& time_s, const std::vector<double>& angle_rad) {
  constexpr double kLeastGap_s = 0.2, kTimesUsual = 2.5, kUsualStep = 0.95;
  std::vector<std::size_t> rows;
  std::vector<double> lasts_s, turned_rad;
  for (std::size_t i = 0; i < angle_rad.size(); ++i) {
    if (std::isnan(angle_rad[i])) continue;
    if (!rows.empty()) {
      lasts_s.push_back(time_s[i] - time_s[rows.back()]);
      turned_rad.push_back(std::abs(angle_rad[i] - angle_rad[rows.back()]));
    }
    rows.push_back(i);
  }
  Readings of{0.0, std::vector<char>(angle_rad.size(), 1)};
  if (lasts_s.empty()) return of;
  of.usual_s = quantile(lasts_s, 0.5);
  // One that is read only as it moves rests in between.
  const double step_rad = quantile(turned_rad, kUsualStep), gap_s = std::max(kLeastGap_s, kTimesUsual * of.usual_s);
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    if (lasts_s[k] > gap_s && turned_rad[k] > step_rad)
      for (std::size_t i = rows[k] + 1; i < rows[k + 1]; ++i) of.is_known[i] = 0;
  return of;
}

}  // namespace

const Channel* Recording::channel(std::string_view wanted) const {
  for (const Channel& c : channels)
    if (c.name == wanted) return &c;
  return nullptr;
}

Channel& Recording::add_channel(std::string channel_name) {
  channels.push_back(
      {std::move(channel_name), std::vector<double>(time_s.size(), std::numeric_limits<double>::quiet_NaN())});
  return channels.back();
}

std::vector<std::string> problems_in(const Recording& recording) {
  std::vector<std::string> problems;
  for (const Channel& c : recording.channels) {
    if (c.values.size() != recording.time_s.size())
      problems.push_back(c.name + ": found " + std::to_string(c.values.size()) +
                         " cells, expected one for each of the " + std::to_string(recording.time_s.size()) + " times");
    for (std::size_t i = 0; i < c.values.size(); ++i)
      if (std::isinf(c.values[i])) {
        problems.push_back(c.name + ": found an infinite value in row " + std::to_string(i + 1) +
                           ", expected a number");
        break;
      }
  }
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (!std::isfinite(recording.time_s[i])) {
      problems.push_back("time_s: found no number in row " + std::to_string(i + 1) + ", expected a time");
      return problems;
    }
    if (i > 0 && recording.time_s[i] < recording.time_s[i - 1]) {
      problems.push_back("time_s: found time going back in row " + std::to_string(i + 1) +
                         ", expected times that never decrease");
      return problems;
    }
  }
  if (const std::optional<std::size_t> row = first_after_jump(recording.time_s))
    problems.push_back(formatted("time_s: found %.10g after %.10g in row %zu, expected %s", recording.time_s[*row],
                                 recording.time_s[*row - 1], *row + 1, kRowsOfOneClock));
  return problems;
}

void fill_between(const std::vector<double>& time_s, std::vector<double>& values) {
  std::size_t last = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (last < i) {
      const double span = time_s[i] - time_s[last];
      for (std::size_t k = last + 1; k < i; ++k) {
        const double u = span > 0.0 ? (time_s[k] - time_s[last]) / span : 1.0;
        values[k] = values[last] + u * (values[i] - values[last]);
      }
    }
    last = i;
  }
}

std::vector<WheelSample> wheel_samples(const Recording& recording, const DifferentialDrive& drive) {
  std::vector<double> left, right;
  if (const Channel* l = recording.channel("left_wheel_rad"), *r = recording.channel("right_wheel_rad");
      sampled(l) && sampled(r)) {
    left = l->values;
    right = r->values;
  } else if (const Channel* lt = recording.channel("left_ticks"), *rt = recording.channel("right_ticks");
             sampled(lt) && sampled(rt)) {
    const double rad_per_count = 2.0 * kPi / drive.counts_per_wheel_turn();
    left = unwrapped_counts(lt->values, drive.counter_bits);
    right = unwrapped_counts(rt->values, drive.counter_bits);
    for (double& v : left) v *= rad_per_count;
    for (double& v : right) v *= rad_per_count;
  } else {
    return {};
  }
  // A wheel that is read far less often than the other did not go straight from one reading to the next.
  constexpr double kFarLessOften = 3.0;
  const Readings of_left = readings_of(recording.time_s, left), of_right = readings_of(recording.time_s, right);
  const bool by_left = of_left.usual_s > kFarLessOften * of_right.usual_s,
             by_right = of_right.usual_s > kFarLessOften * of_left.usual_s;
  std::vector<char> read(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const bool is_left = !std::isnan(left[i]), is_right = !std::isnan(right[i]);
    read[i] = (by_left    ? is_left
               : by_right ? is_right
                          : is_left || is_right) &&
              of_left.is_known[i] && of_right.is_known[i];
  }
  fill_between(recording.time_s, left);
  fill_between(recording.time_s, right);
  std::vector<WheelSample> samples;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (read[i] && !std::isnan(left[i]) && !std::isnan(right[i]))
      samples.push_back({recording.time_s[i], left[i], right[i]});
  return samples;
}

std::vector<CommandSample> command_samples(const Recording& recording) {
  const Channel* v = recording.channel("command_speed_mps");
  const Channel* w = recording.channel("command_yaw_rate_radps");
  if (!v || !w) return {};
  std::vector<CommandSample> samples;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i)
    if (!std::isnan(v->values[i]) && !std::isnan(w->values[i]))
      samples.push_back({recording.time_s[i], v->values[i], w->values[i]});
  return samples;
}

std::vector<TruthSample> truth_samples(const Recording& recording) {
  const Channel* x = recording.channel("truth_x_m");
  const Channel* y = recording.channel("truth_y_m");
  const Channel* heading = recording.channel("truth_heading_rad");
  if (!x || !y) return {};
  std::vector<TruthSample> samples;
  std::optional<double> previous;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (std::isnan(x->values[i]) || std::isnan(y->values[i])) continue;
    TruthSample sample{recording.time_s[i], {x->values[i], y->values[i]}, std::nullopt};
    if (heading && !std::isnan(heading->values[i])) {
      sample.heading_rad = previous ? unwrapped(heading->values[i], *previous) : heading->values[i];
      previous = sample.heading_rad;
    }
    samples.push_back(sample);
  }
  return samples;
}

Track truth_track(const Recording& recording) {
  Track track;
  for (const TruthSample& s : truth_samples(recording))
    if (s.heading_rad) track.push_back({s.time_s, {s.position.x_m, s.position.y_m, *s.heading_rad}});
  return track;
}

}  // namespace odolab
