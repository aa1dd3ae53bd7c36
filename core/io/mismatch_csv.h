// What the window shows of a run as CSV: the mismatch sample by sample, and how far the simulation is from the truth.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/diagnosis/mismatch.h"
#include "core/geometry/track.h"

namespace odolab {

// One row for each truth sample within the stretches, or for all where there are none: `time_s,x_m,y_m,heading_rad`,
// the same `simulated_…`, and `mismatch_calibrated`, `mismatch_with_findings` in times the noise. A cell is empty where
// there is no such number. `simulated` may be at other times than the truth, or empty.
Result<Done> write_mismatch_csv(const std::string& path, const MismatchOverTime& mismatch, const Track& truth,
                                const Track& simulated, const std::vector<std::pair<double, double>>& stretches);

}  // namespace odolab
