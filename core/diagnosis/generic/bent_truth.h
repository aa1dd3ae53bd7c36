// Whether the truth itself is bent: positions that are off by where they were taken, as through a camera's lens, over a
// tilted plane, or by a scale that is not the same along both axes.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Cubic polynomials of the place on what the truth says of it, but for what turning, shifting and scaling alike do:
// once with headings that are true, once with headings taken off the same picture. p values are over `looked_at` tests.
std::vector<GenericTest> bent_truth_tests(const AskedModel& asked, double looked_at);
constexpr int kBentTruthTests = 2;

}  // namespace odolab
