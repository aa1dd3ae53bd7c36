// Whether something on the vehicle swings on after its speed or yaw rate changed, and carries it to and fro while its
// wheels know nothing of it: half a tank, a load on ropes, a mast, a body on soft springs.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// A test for each of some periods, of recordings with encoders. Shorter ones `after_changes.h` hears, whatever their
// form. p values are over `looked_at` tests.
std::vector<GenericTest> swinging_tests(const AskedModel& asked, double looked_at);
constexpr int kSwingingTests = 7, kSwingingTestsApart = 4;  // neighbours say half the same

}  // namespace odolab
