#include "core/diagnosis/quality/wheels_at_one_time.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace odolab {

namespace {

void move_right_wheel_on(Recording& recording, const DifferentialDrive& drive, double by_s) {
  constexpr std::size_t kAbout = 2;  // readings to either side, so that stamps that tremble hardly matter
  constexpr double kLongest_s = 2.0;
  for (Channel& c : recording.channels) {
    if (c.name != "right_ticks" && c.name != "right_wheel_rad") continue;
    const bool wraps = c.name == "right_ticks" && drive.counter_bits > 0;
    const double range = wraps ? std::exp2(drive.counter_bits) : 0.0;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < c.values.size(); ++i)
      if (!std::isnan(c.values[i])) rows.push_back(i);
    const std::vector<double> read = c.values;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::size_t from = rows[k - std::min(k, kAbout)], to = rows[std::min(k + kAbout, rows.size() - 1)];
      const double over_s = recording.time_s[to] - recording.time_s[from];
      const double turned = wraps ? std::remainder(read[to] - read[from], range) : read[to] - read[from];
      if (over_s > 0.0 && over_s < kLongest_s) c.values[rows[k]] += by_s * turned / over_s;
    }
  }
}

}  // namespace

std::vector<Recording> with_right_wheel_newer(std::vector<Recording> recordings, const DifferentialDrive& drive,
                                              double by_s) {
  for (Recording& recording : recordings) move_right_wheel_on(recording, drive, by_s);
  return recordings;
}

}  // namespace odolab
