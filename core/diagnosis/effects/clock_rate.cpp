// The clock of encoders or commands runs fast (positive) or slow against the clock of the truth.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> clock_rate() {
  Effect e;
  e.name = "clock_rate";
  e.component = "vehicle";
  e.amplitudes = {{"rate", "1", 5e-4, -0.05, 0.05}};
  e.sentence = "the vehicle's clock and the truth's run at different rates";
  e.regime = "grows with the time since the start";
  e.looks_like = {"truth_time_offset", "traction_slip"};
  e.told_apart_by = "starts and stops early and late in a long run";
  e.clock_rate = true;
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    return std::vector<Motions>{Motions(view.steps.size())};
  };
  return {e};
}

}  // namespace odolab::effects
