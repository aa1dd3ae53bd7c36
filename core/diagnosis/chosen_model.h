// A diagnosis with some of its findings switched on: the calibration that belongs to just these.
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"

namespace odolab {

// Whether a finding has a form that predicts, so that it can be switched on: not a fault of the data, not an effect
// without a name, and not what the calibrated vehicle holds already.
bool can_be_switched_on(const Finding& finding);

// Whether the model with the findings has any that the one without does not: no fault of the data, not what has no
// name, and not what calibration takes up by itself, which is where the tracked point sits and how late the truth is.
bool any_is_put_in(const Diagnosis& diagnosis);

// With none on the calibration alone, with all the fitted model. In between the findings act as they were fitted, and
// radii, wheelbase, mounting and clocks of a differential drive are fitted anew to `train`, the recordings that the
// diagnosis was fitted on; the units of other vehicles keep the calibration of the whole.
// `on`: one for each finding. An error where a recording cannot be read any more.
Result<FittedModel> model_with(const Diagnosis& diagnosis, const std::vector<bool>& on,
                               const std::vector<Recording>& train, const Vehicle& nominal);

}  // namespace odolab
