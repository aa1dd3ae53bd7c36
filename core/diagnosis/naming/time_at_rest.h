// When something happened that mostly happens while the vehicle stands.
#pragma once

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

struct UncertainTime {
  double at_s = 0.0, stderr_s = 0.0;
};

// Of an accepted effect whose shape `entry` is a time, known so far to that summit of its likelihood: there are others,
// since what is small is told from noise over seconds; and while the wheels rest nothing tells one time from another. A
// second at rest is as likely beforehand as five on the way. The mean and the spread over all times, by what the
// likelihood says of each; where the mean is no such time, the summit and the spread about it.
UncertainTime time_with_rests(const JointModel& joint, int accepted, int entry, const UncertainTime& summit,
                              double inflation);

}  // namespace odolab
