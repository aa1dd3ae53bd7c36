// A recording whose truth is stamped by another clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/recording/recording.h"

namespace odolab::test {

// Late by `offset_s` at the first truth sample; `rate`: by how much the wheels' clock is faster.
inline Recording with_truths_clock(const Recording& r, double offset_s, double rate) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto is_truth = [](const Channel& c) { return c.name.rfind("truth_", 0) == 0; };
  std::map<double, std::vector<double>> rows;  // by time
  const auto put = [&](double time_s, std::size_t channel, double value) {
    std::vector<double>& row = rows[time_s];
    row.resize(r.channels.size(), kNone);
    row[channel] = value;
  };
  double first_s = kNone;
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    for (std::size_t c = 0; c < r.channels.size(); ++c) {
      const double value = r.channels[c].values[i];
      if (std::isnan(value)) continue;
      if (!is_truth(r.channels[c])) {
        put(r.time_s[i], c, value);
        continue;
      }
      if (std::isnan(first_s)) first_s = r.time_s[i];
      put(first_s + offset_s + (r.time_s[i] - first_s) / (1.0 + rate), c, value);
    }
  Recording out = r;
  out.time_s.clear();
  for (Channel& c : out.channels) c.values.clear();
  for (const auto& [time_s, row] : rows) {
    out.time_s.push_back(time_s);
    for (std::size_t c = 0; c < row.size(); ++c) out.channels[c].values.push_back(row[c]);
  }
  return out;
}

}  // namespace odolab::test
