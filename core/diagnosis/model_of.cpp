#include "core/diagnosis/fitted_model.h"

namespace odolab {

namespace {

bool has_parameter(const ActiveEffect& active, const std::string& name) {
  for (const auto& [key, value] : active.parameters)
    if (key == name) return true;
  return false;
}

}  // namespace

FittedModel model_of(const Diagnosis& diagnosis) {
  FittedModel model{diagnosis.calibration.vehicle, {}};
  for (const Finding& finding : diagnosis.findings) {
    if (finding.effect == "unknown" || finding.effect == "truth_frozen" || finding.effect == "encoder_data_fault") continue;
    FittedEffect effect{finding.as_active(), {}, ""};
    for (const FoundParameter& p : finding.parameters) effect.stderr_values.emplace_back(p.name, p.stderr_value);
    // what is tied to a time and not to a place happened once
    if (has_parameter(effect.active, "at_s") && !has_parameter(effect.active, "x_m")) effect.recording = finding.where.recording;
    model.effects.push_back(effect);
  }
  return model;
}

}  // namespace odolab
