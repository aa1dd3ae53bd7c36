// What calibration leaves and what the findings leave of it, for pictures: its response to each variable, and sample by
// sample.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic_tests.h"

namespace odolab {

// Of what calibration leaves to each variable that has an axis or is an angle; `found`: `generic_now` is of what
// findings leave, and stands beside.
std::vector<Response> responses_of(const JointModel& calibrated, const std::vector<GenericTest>& generic_now,
                                   bool found);

std::vector<Residuals> residuals_of(const JointModel& joint);

}  // namespace odolab
