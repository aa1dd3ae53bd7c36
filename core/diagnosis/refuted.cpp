#include "core/diagnosis/refuted.h"

#include <algorithm>

#include "core/diagnosis/chosen_model.h"

namespace odolab {

namespace {

bool is_worse(const std::optional<FitFigures>& before, const std::optional<FitFigures>& after) {
  constexpr double kWorse = 1.1, kBetter = 0.95;
  if (!before || !after || !(after->position_rms_m > kWorse * before->position_rms_m)) return false;
  return !(after->heading_rms_rad < kBetter * before->heading_rms_rad);
}

}  // namespace

bool is_refuted_by_unseen(const Diagnosis& d) {
  return !d.findings.empty() && is_worse(d.held_out.calibrated, d.held_out.with_findings);
}

bool simulator_follows(const Diagnosis& d) {
  constexpr double kAsFar = 2.0;
  const std::optional<FitFigures>&model = d.train.calibrated, &simulated = d.simulation.calibrated;
  if (!model || !simulated || !model->gathered()) return true;
  return simulated->position_rms_m < kAsFar * model->position_rms_m ||
         simulated->heading_rms_rad < kAsFar * model->heading_rms_rad;
}

bool simulator_lacks_the_form(const Diagnosis& d) {
  return std::any_of(d.findings.begin(), d.findings.end(),
                     [](const Finding& f) { return f.effect == "slip_zone" && f.form > 0; });
}

bool is_refuted_by_simulator(const Diagnosis& d) {
  if (!simulator_follows(d) || simulator_lacks_the_form(d)) return false;
  // A base that is late and a clock that is are one and the same, with the finding and without.
  const bool any_physics = std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return can_be_switched_on(f) && f.effect != "actuator_delay" && f.effect != "clock_rate";
  });
  return any_physics && is_worse(d.simulation.calibrated, d.simulation.with_findings);
}

}  // namespace odolab
