// Play between the motor, where the encoder sits, and the wheel: after a reversal the wheel stands until the gap is
// crossed.
#include <algorithm>

#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class DrivetrainBacklash final : public Effect {
 public:
  explicit DrivetrainBacklash(const ActiveEffect& a) : component_(a.component), gap_rad_(a.parameter("gap_rad")) {}

  void gear(Side side, double& turn_rad) override {
    if (!acts_on(component_, side)) return;
    double& play_rad = play_rad_[side == Side::left ? 0 : 1];
    const double moved = play_rad + turn_rad;
    play_rad = std::clamp(moved, -gap_rad_, 0.0);
    turn_rad = moved - play_rad;
  }

 private:
  std::string component_;
  double gap_rad_;
  double play_rad_[2] = {0.0, 0.0};  // 0: the motor pushes forward, -gap: it pushes backward
};

}  // namespace

std::unique_ptr<Effect> drivetrain_backlash(const ActiveEffect& active, const Machine&) {
  return std::make_unique<DrivetrainBacklash>(active);
}

}  // namespace odolab::planar
