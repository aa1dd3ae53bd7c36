// An outside measurement of the pose: a sonar corner (UMBmark: 2 mm, 0.4 degrees) or motion capture.
#pragma once

#include "core/base/random.h"
#include "core/geometry/pose.h"

namespace odolab {

struct AbsolutePoseSensor {
  double position_noise_m = 0.002;          // standard deviation in x and in y
  double heading_noise_rad = radians(0.4);  // standard deviation

  Pose measure(const Pose& true_pose, Random& random) const {
    const double x = random.normal(), y = random.normal(), heading = random.normal();  // drawn in this order everywhere
    return {true_pose.x_m + position_noise_m * x, true_pose.y_m + position_noise_m * y,
            true_pose.heading_rad + heading_noise_rad * heading};
  }
};

}  // namespace odolab
