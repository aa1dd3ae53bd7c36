// What joints read, as all units of a vehicle tell it together beside an outside truth that is fine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// Biased encoders of `geometry` anew, where that makes them known better: one filter holds the poses of all units
// (together/), so that the way from one stretch to the next says what it knows, too. `of_units`: what was found on each
// and lasts is taken off; where something happened, at a place or a moment, what wheels turned is a guess. `names`: of
// the recordings. An encoder that errs otherwise than by a bias is returned as a finding without a name.
std::optional<Finding> tell_joints_by_all(const std::vector<JoinedRun>& runs, const std::vector<Recording>& recordings,
                                          const std::vector<std::string>& names, const std::vector<Diagnosis>& of_units,
                                          const Vehicle& nominal, double family_wise_error, GeometryFit& geometry);

}  // namespace odolab
