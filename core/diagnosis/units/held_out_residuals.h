// What a fitted model of a linked or castor vehicle leaves in recordings that it was not fitted to.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// Under which a unit's residuals of a recording stand: "run.csv, truck_b"; the recording's own name for the vehicle
// itself, or the unit that tows.
std::string recording_of_unit(const std::string& recording, const std::string& unit);

// As with_held_out_residuals (core/diagnosis/predicted_mismatch.h) for the kinds of has_units: those of every unit, the
// first, whose mismatch stands for the vehicle's in pictures, before the others. The noise is that which the same unit
// has beside the effects in `fitted`, the recordings that the diagnosis was fitted on. What has no truth with headings
// is left out.
Diagnosis with_held_out_residuals_of_units(const Diagnosis& diagnosis, const std::vector<Recording>& fitted,
                                           const std::vector<Recording>& held_out, const Vehicle& nominal);

}  // namespace odolab
