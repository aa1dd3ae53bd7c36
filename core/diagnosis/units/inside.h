// Units judged against each other, where there is no outside truth that has headings to judge them by. README.md, "From
// the inside" and "Positions alone".
#pragma once

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/others_way.h"
#include "core/diagnosis/units/outside_truth.h"

namespace odolab {

// As diagnose_units, of vehicles with two units or more that drive by encoders on both sides of their joints. `truth`:
// what the recordings have. Positions tell all units together where they are and how large, and ends how large;
// without either what all do alike does not show, and neither does the scale.
Result<Diagnosis> diagnose_inside(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal, OutsideTruth truth, const DiagnosisOptions& options,
                                  const Progress& progress);

}  // namespace odolab
