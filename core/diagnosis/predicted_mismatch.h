// What a fitted model leaves in a recording that it was not fitted to.
#pragma once

#include "core/base/result.h"
#include "core/calibration/innovations.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"

namespace odolab {

// Innovations of a differential drive's recording under a model, as Residuals has those of the recordings that were
// fitted. Nothing is fitted to it but the offset of the truth's clock, which is every recording's own. `nominal` reads
// its encoders; `noise` is that of the fit. An error where it has no wheels or no truth.
Result<Residuals> residuals_under(const FittedModel& model, const FittedNoise& noise, const Recording& recording,
                                  const Vehicle& nominal);

// The diagnosis with the innovations of these held-out recordings beside those of the fitted ones, so that their
// mismatch can be drawn too; what cannot be predicted is left out. Vehicles of several units stay as they are.
Diagnosis with_held_out_residuals(const Diagnosis& diagnosis, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal);

}  // namespace odolab
