// What calibration leaves and what the findings leave of it, for pictures: its response to each variable, and sample by
// sample.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Of what calibration leaves to each variable that has an axis or is an angle, strongest first; where something was
// `found`, with what that leaves beside it.
std::vector<Response> responses_of(std::vector<GenericTest> tests, bool found);

std::vector<Residuals> residuals_of(const JointModel& joint);

}  // namespace odolab
