#include "core/diagnosis/active_effect.h"

namespace odolab {

TruthMounting truth_under(const std::vector<ActiveEffect>& effects, TruthMounting truth) {
  for (const ActiveEffect& a : effects) {
    if (a.effect == "truth_time_offset") truth.time_offset_s = a.parameter("offset_s");
    if (a.effect == "truth_mounting_offset")
      truth.axle_T_tracked = {a.parameter("x_m"), a.parameter("y_m"), a.parameter("heading_rad")};
  }
  return truth;
}

}  // namespace odolab
