// Both wheels roll at one angle to straight ahead: tan of it is the sideways way of each metre.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class WheelToe final : public Effect {
 public:
  explicit WheelToe(const ActiveEffect& a) : angle_rad_(std::atan(a.parameter("sideways_per_metre"))) {}

  void build_into(ActualDrive& actual) const override {
    actual.toe_left_rad += angle_rad_;
    actual.toe_right_rad += angle_rad_;
  }

 private:
  double angle_rad_;
};

}  // namespace

std::unique_ptr<Effect> wheel_toe(const ActiveEffect& active, const Machine&) {
  return std::make_unique<WheelToe>(active);
}

}  // namespace odolab::planar
