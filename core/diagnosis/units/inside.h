// Units judged against each other, where there is no outside truth to judge them by. README.md, "From the inside".
#pragma once

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/others_way.h"

namespace odolab {

// As diagnose_units, of vehicles with two units or more that drive by encoders on both sides of their joints. What all
// units do alike does not show; neither does the scale.
Result<Diagnosis> diagnose_inside(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress);

}  // namespace odolab
