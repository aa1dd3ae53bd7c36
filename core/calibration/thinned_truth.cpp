#include "core/calibration/thinned_truth.h"

#include <algorithm>
#include <cmath>

namespace odolab {

InnovationRun thinned_truth(const InnovationRun& run, const InnovationModel& model, double way_m) {
  InnovationRun thin = run;
  thin.truth.clear();
  thin.set_aside.clear();
  double left_m = 0.0, right_m = 0.0;  // rolled since the last sample that was kept, there and back
  std::size_t i = 0;
  for (std::size_t t = 0; t < run.truth.size(); ++t) {
    const double now_s = run.truth[t].time_s - model.truth.time_offset_s;
    for (; i + 1 < run.wheels.size() && run.wheels[i + 1].time_s <= now_s; ++i) {
      left_m += model.drive.wheel_radius_left_m * std::abs(run.wheels[i + 1].left_rad - run.wheels[i].left_rad);
      right_m += model.drive.wheel_radius_right_m * std::abs(run.wheels[i + 1].right_rad - run.wheels[i].right_rad);
    }
    const bool begins_anew = run.set_aside[t] == 2;
    const bool rolled = run.set_aside[t] == 0 && std::max(left_m, right_m) >= way_m;
    if (t > 0 && !begins_anew && !rolled) continue;
    thin.truth.push_back(run.truth[t]);
    thin.set_aside.push_back(run.set_aside[t]);
    left_m = right_m = 0.0;
  }
  return thin;
}

}  // namespace odolab
