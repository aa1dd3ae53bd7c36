// What whole counts do to a wheel that stops and sets off.
#pragma once

#include <array>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

// A driver that stops by its counts stops just behind one: at rest the reading is ahead of the wheel, by half a count
// beyond its mean while it turns. So half a count is lost when the wheel sets off and regained when it stops. The
// motion of the left and of the right wheel for a whole half count, in the direction of the movement before; nothing
// where the readings are not whole counts. How much of it there is depends on the driver: 0 where it stops anywhere.
std::array<Motions, 2> counts_at_rest(const InnovationRun& run, const DifferentialDrive& drive);

}  // namespace odolab
