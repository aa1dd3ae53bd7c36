#include "core/diagnosis/refuted.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/chosen_model.h"
#include "core/scenario/effect_catalogue.h"

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
  const std::optional<FitFigures>& simulated = d.simulation.calibrated;
  if (!d.train.calibrated || !simulated || !d.train.calibrated->gathered()) return true;
  FitFigures model = *d.train.calibrated;
  if (d.held_out.calibrated && !d.left_out_in_turn) {  // the simulator drives those, too
    model.position_rms_m = std::max(model.position_rms_m, d.held_out.calibrated->position_rms_m);
    model.heading_rms_rad = std::fmax(model.heading_rms_rad, d.held_out.calibrated->heading_rms_rad);
  }
  return simulated->position_rms_m < kAsFar * model.position_rms_m ||
         simulated->heading_rms_rad < kAsFar * model.heading_rms_rad;
}

std::vector<Finding> beyond_the_simulator(const Diagnosis& d) {
  std::vector<Finding> beyond;
  for (const Finding& f : d.findings)
    if (can_be_switched_on(f) && !can_be_played(f.as_active())) beyond.push_back(f);
  return beyond;
}

bool is_refuted_by_simulator(const Diagnosis& d) {
  if (!simulator_follows(d) || !beyond_the_simulator(d).empty()) return false;
  // A base that is late and a clock that is are one and the same, with the finding and without.
  const bool any_physics = std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return can_be_switched_on(f) && f.effect != "actuator_delay" && f.effect != "clock_rate";
  });
  return any_physics && is_worse(d.simulation.calibrated, d.simulation.with_findings);
}

}  // namespace odolab
