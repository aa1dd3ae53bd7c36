// Whether the truth's heading is off by where on the floor it is taken.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Two tests on a grid over the floor: of the place alone, as where cameras do not agree or a map was joined from
// pieces, and of the place and where the body heads there, as of a compass beside iron. Where the truth has no headings
// nothing is left of them; and none is asked where half of the way and more is met with one heading alone. p values are
// over `looked_at` tests.
std::vector<GenericTest> truth_by_place_tests(const AskedModel& asked, double looked_at);
constexpr int kTruthByPlaceTests = 2;

}  // namespace odolab
