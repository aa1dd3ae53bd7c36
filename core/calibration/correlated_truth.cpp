#include "core/calibration/correlated_truth.h"

#include <cmath>
#include <limits>

#include "core/recording/truth_left_out.h"

namespace odolab {

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
      next_s = recording.time_s[i] + apart_s;
  }
  leave_truth_out(out, dropped);
  return out;
}

}  // namespace odolab
