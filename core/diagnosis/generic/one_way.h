// What happens in one of two ways alone: where it brakes and not where it speeds up, or in reverse and not forwards.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Of one number each, since a name that acts in both ways says half of it or more. Slip where it brakes, and where it
// speeds up; a wheel that rolls otherwise in reverse (a tread with a direction, a wheel that is pulled aside), the left
// one, the right one and both. p values are over `looked_at` tests.
std::vector<GenericTest> one_way_tests(const AskedModel& asked, double looked_at);
constexpr int kOneWayTests = 5;

}  // namespace odolab
