// Whether it goes anywhere as it turns on the spot.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// One test: forward for each radian that is turned while the wheels go against each other, to either side alike and by
// the side. A wheel that slips where the other does not, and a castor that is dragged along, carry the middle of the
// axle so. p values are over `looked_at` tests.
std::vector<GenericTest> on_the_spot_tests(const AskedModel& asked, double looked_at);
constexpr int kOnTheSpotTests = 1;

}  // namespace odolab
