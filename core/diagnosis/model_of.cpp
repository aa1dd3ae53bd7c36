#include "core/diagnosis/fitted_model.h"

namespace odolab {

FittedModel model_of(const Diagnosis& diagnosis) {
  FittedModel model{diagnosis.calibration.vehicle, {}};
  for (const Finding& finding : diagnosis.findings) {
    if (finding.effect == "unknown" || finding.effect == "truth_frozen" || finding.effect == "encoder_data_fault") continue;
    FittedEffect effect{finding.as_active(), {}};
    for (const FoundParameter& p : finding.parameters) effect.stderr_values.emplace_back(p.name, p.stderr_value);
    model.effects.push_back(effect);
  }
  return model;
}

}  // namespace odolab
