// One number for each of two wheels on an axle.
#pragma once

namespace odolab {

struct WheelPair {
  double left = 0.0;
  double right = 0.0;
};

}  // namespace odolab
