// Units judged by an outside truth that has headings, a sample a second or more, each through what its joints read. An
// encoder trailer by the poses of both ends as well. README.md, sections 1 to 6.
#pragma once

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// As diagnose_units, of recordings whose stamps are even.
Result<Diagnosis> diagnose_beside_truth(const std::vector<Recording>& recordings,
                                        const std::vector<Recording>& held_out, const Vehicle& nominal,
                                        const DiagnosisOptions& options, const Progress& progress);

}  // namespace odolab
