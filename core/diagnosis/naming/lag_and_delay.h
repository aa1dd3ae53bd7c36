// A lag and a clock's offset, which feign each other.
#pragma once

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Puts the effect that was let in last, a lag, to the size at which the likelihood is largest, all else fitted anew, and
// holds it there. The offset that would do nearly as well changes with the lag along a valley that is bent: steps along
// the columns run out of it, to and fro.
void put_lag_where_likeliest(JointModel& joint);

}  // namespace odolab
