// A diagnosis in which what names leave has no say.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// As diagnose() (diagnosis.h) of a differential drive, where what is left beside names is known to be no physics of it:
// what the units of one vehicle do to each other.
Result<Diagnosis> diagnose_by_names(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                    const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress);

}  // namespace odolab
