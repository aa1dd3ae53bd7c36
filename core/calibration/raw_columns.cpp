#include "core/calibration/raw_columns.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/recording/clock_jump.h"

namespace odolab {

namespace {

// By how many bits a counter wraps, and how often; zero bits where it does not.
struct Wrap {
  int bits = 0, times = 0;
};

Wrap wrap_of(const std::vector<double>& values) {
  constexpr double kJump = 0.75;  // of the counter's range: more in one reading is no pace
  constexpr double kPace = 2.0;   // times the fast steps beside the jumps
  constexpr double kFast = 0.99;  // of all steps are slower: the fastest may be another loss, which is no pace
  constexpr std::size_t kFewest = 50;
  std::vector<double> counts;
  for (double v : values)
    if (!std::isnan(v)) counts.push_back(v);
  if (counts.size() < kFewest) return {};
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  const int bits = static_cast<int>(std::ceil(std::log2(*most - *least + 1.0)));
  const double range = std::ldexp(1.0, bits);
  std::vector<double> steps;
  double over_the_end = 0.0;
  int times = 0;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    const double step = counts[i] - counts[i - 1];
    if (std::abs(step) < kJump * range) {
      if (step != 0.0) steps.push_back(std::abs(step));
      continue;
    }
    over_the_end = std::max(over_the_end, range - std::abs(step));
    ++times;
  }
  if (times == 0 || steps.empty() || over_the_end > kPace * std::max(1.0, quantile(std::move(steps), kFast))) return {};
  return {bits, times};
}

}  // namespace

std::optional<Error> stamps_in_no_seconds(const Recording& recording) {
  constexpr double kMicroseconds = 3e3, kNanoseconds = 3e6;  // from so many apart on
  const std::optional<double> usual = far_apart_s(recording.time_s);
  if (!usual) return std::nullopt;
  const char* unit = *usual < kMicroseconds  ? "milliseconds"
                     : *usual < kNanoseconds ? "microseconds"
                                             : "nanoseconds";
  const std::string found = formatted("rows %.3g apart, which look like %s", *usual, unit);
  return Error{"time_s", found, "seconds"};
}

std::optional<Error> unknown_wrap(const Recording& recording, const DifferentialDrive& drive) {
  if (drive.counter_bits > 0) return std::nullopt;
  for (const char* name : {"left_ticks", "right_ticks"}) {
    const Channel* ticks = recording.channel(name);
    if (!ticks) continue;
    const Wrap wrap = wrap_of(ticks->values);
    if (wrap.bits < 8) continue;
    const std::string bits = std::to_string(wrap.bits);
    return Error{name,
                 "a count that jumps back or on by 2^" + bits + " and goes on at its pace (" +
                     std::to_string(wrap.times) + " times), as a counter of " + bits + " bits does where it wraps",
                 "counter_bits = " + bits + " in the vehicle's file, or counts that do not wrap"};
  }
  return std::nullopt;
}

}  // namespace odolab
