// Whether the truth is late, by more at one time or place than at another.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Two tests: hats over the time since the start, and quadratic polynomials of the place. A truth that is late by so
// much is off by that times the velocity; what it is late by throughout a recording is the clock's offset. A link that
// buffers, a filter that is set anew and a picture that is read line by line show. p values are over `looked_at` tests.
std::vector<GenericTest> late_truth_tests(const AskedModel& asked, double looked_at);
constexpr int kLateTruthTests = 2;

}  // namespace odolab
