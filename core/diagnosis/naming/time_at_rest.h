// When something happened that mostly happens while the vehicle stands.
#pragma once

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

struct UncertainTime {
  double at_s = 0.0, stderr_s = 0.0;
};

// Of an accepted effect whose shape `entry` is a time, known so far to that: while the wheels rest nothing tells one time
// from another, and a second at rest is as likely beforehand as five on the way. The mean and the spread of both, by what
// the likelihood says of each.
UncertainTime time_with_rests(const JointModel& joint, int accepted, int entry, const UncertainTime& on_the_way,
                              double inflation);

}  // namespace odolab
