// Whether it goes anywhere while its wheels stand.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Two tests, of recordings with encoders (what a base is told when it stands it follows late); else none. Hats over the
// time since both wheels came to rest: so fast it turns, and goes ahead. A brake that takes hold of one side first, an
// engine that shakes it round, a tether or a slope that pulls its tyres along carry it so. p values are over
// `looked_at` tests.
std::vector<GenericTest> at_rest_tests(const AskedModel& asked, double looked_at);
constexpr int kAtRestTests = 2;

}  // namespace odolab
