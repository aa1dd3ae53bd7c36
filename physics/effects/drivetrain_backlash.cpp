// Play between the motor, where the encoder sits, and the wheel: after a reversal the wheel stands until the gap is
// crossed. With a drag, a wheel that neither flank touches is braked by that alone: where the motor brakes harder, the
// wheel drives on across the gap.
#include <algorithm>
#include <cmath>

#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class DrivetrainBacklash final : public Effect {
 public:
  DrivetrainBacklash(const ActiveEffect& a, const Machine& machine)
      : component_(a.component), gap_rad_(a.parameter("gap_rad")), step_s_(machine.step_s) {
    const double drag_mps2 = a.parameter("drag_mps2", 0.0);
    drag_radps2_[0] = drag_mps2 / machine.actual.wheel_radius_left_m;
    drag_radps2_[1] = drag_mps2 / machine.actual.wheel_radius_right_m;
  }

  void gear(Side side, double& turn_rad) override {
    if (!acts_on(component_, side)) return;
    const int wheel = side == Side::left ? 0 : 1;
    double& play_rad = play_rad_[wheel];
    double& speed_radps = speed_radps_[wheel];
    speed_radps -= std::copysign(std::min(std::abs(speed_radps), drag_radps2_[wheel] * step_s_), speed_radps);
    if (drag_radps2_[wheel] == 0.0) speed_radps = 0.0;
    const double moved = play_rad + turn_rad, free = moved - speed_radps * step_s_;
    play_rad = std::clamp(free, -gap_rad_, 0.0);
    if (play_rad != free) speed_radps = turn_rad / step_s_;  // a flank carries it along
    turn_rad = moved - play_rad;
    between_flanks_[wheel] = play_rad == free && gap_rad_ > 0.0;
  }

  bool holds(Side side) const override { return !between_flanks_[side == Side::left ? 0 : 1]; }

 private:
  std::string component_;
  double gap_rad_, step_s_;
  double drag_radps2_[2];
  double speed_radps_[2] = {0.0, 0.0};  // of the wheel
  bool between_flanks_[2] = {false, false};
  double play_rad_[2] = {0.0, 0.0};     // 0: the motor pushes forward, -gap: it pushes backward
};

}  // namespace

std::unique_ptr<Effect> drivetrain_backlash(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<DrivetrainBacklash>(active, machine);
}

}  // namespace odolab::planar
