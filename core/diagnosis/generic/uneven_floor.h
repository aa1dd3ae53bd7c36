// Whether the vehicle creeps across the floor otherwise from place to place: towards a drain, off a crown, on a floor
// that is warped; or it is pulled to one point, as by a cable.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// One test: a creep in the room, while a wheel turns, that is linear in the place. p values are over `looked_at` tests.
std::vector<GenericTest> uneven_floor_tests(const AskedModel& asked, double looked_at);
constexpr int kUnevenFloorTests = 1;

}  // namespace odolab
