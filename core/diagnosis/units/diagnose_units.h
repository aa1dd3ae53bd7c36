// Where a linked or castor vehicle and its model differ: each unit diagnosed as the differential drive that it is.
#pragma once

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// As `diagnose`, for the kinds of has_units (vehicle_units.h).
Result<Diagnosis> diagnose_units(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                                 const Vehicle& nominal, const DiagnosisOptions& options = {},
                                 const Progress& progress = {});

}  // namespace odolab
