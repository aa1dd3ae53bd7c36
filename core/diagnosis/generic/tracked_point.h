// Whether the point that the truth tracks is elsewhere on the vehicle, or its heading is measured otherwise, as the
// vehicle heads otherwise or from recording to recording.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Five tests: the position and the heading that are measured, each by what goes once and twice a turn of the heading;
// the position by what goes three, four and six times a turn, as of a target of so many faces; where the point is
// mounted, in each recording; and on which side of a mount with play the body's last turn left it. A marker that is
// seen from one side and another from behind, an antenna in the shade of what it stands on, a compass beside iron, a
// prism, a marker that was put on anew, by less than `moved_mounting` puts right, and one that is loose, show. p values
// are over `looked_at` tests.
std::vector<GenericTest> tracked_point_tests(const AskedModel& asked, double looked_at);
constexpr int kTrackedPointTests = 6;

}  // namespace odolab
