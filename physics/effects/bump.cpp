// Something round on the floor, as high as it takes to make the wheel turn so much further than it travels.
#include <algorithm>

#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// The height over which a wheel rolls `extra_m` further than it travels; what it can climb ends at its axle.
double height_for(double radius_m, double extra_m) {
  double low_m = 0.0, high_m = radius_m;
  for (int k = 0; k < 60; ++k) {
    const double middle_m = 0.5 * (low_m + high_m);
    (extra_roll_m(radius_m, middle_m) < extra_m ? low_m : high_m) = middle_m;
  }
  return high_m;
}

class BumpOnTheFloor final : public Effect {
 public:
  BumpOnTheFloor(const ActiveEffect& a, const ActualDrive& actual) {
    const Under under = a.component == "left_wheel"    ? Under::left_wheel
                        : a.component == "right_wheel" ? Under::right_wheel
                                                       : Under::any_wheel;
    const double radius_m = under == Under::right_wheel ? actual.wheel_radius_right_m : actual.wheel_radius_left_m;
    bump_.centre = {a.parameter("x_m"), a.parameter("y_m")};
    bump_.length_m = 2.0 * a.parameter("radius_m", 0.1);
    bump_.height_m = height_for(radius_m, a.parameter("extra_distance_m"));
    bump_.under = under;
    bump_.round = true;
  }

  void lay_on(Floor& floor) const override { floor.bumps.push_back(bump_); }

 private:
  Bump bump_;
};

}  // namespace

std::unique_ptr<Effect> bump(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<BumpOnTheFloor>(active, machine.actual);
}

}  // namespace odolab::planar
