// Play between the motor, where the encoder sits, and the wheel: after a reversal the wheel stands until the gap is
// crossed. With a drag, a wheel that neither flank touches is braked by that alone: where the motor brakes harder, the
// wheel drives on across the gap.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class DrivetrainBacklash final : public Effect {
 public:
  DrivetrainBacklash(const ActiveEffect& a, const Machine& machine)
      : component_(a.component), gap_rad_(a.parameter("gap_rad")), form_(form_of(a)), step_s_(machine.step_s) {
    const effects::PlayForm form = effects::kPlayForms[form_.value_or(0)];
    over_rad_ = form_ ? std::max(gap_rad_, form.yields_rad) : gap_rad_;
    const double drag_mps2 = a.parameter("drag_mps2", form.drag_mps2);
    drag_radps2_[0] = drag_mps2 / machine.actual.wheel_radius_left_m;
    drag_radps2_[1] = drag_mps2 / machine.actual.wheel_radius_right_m;
  }

  void gear(Side side, double& turn_rad) override {
    if (!acts_on(component_, side)) return;
    const int wheel = side == Side::left ? 0 : 1;
    double& play_rad = play_rad_[wheel];
    double& speed_radps = speed_radps_[wheel];
    if (form_ && !has_begun_[wheel] && turn_rad != 0.0) play_rad = at_the_start_rad(turn_rad);
    has_begun_[wheel] = has_begun_[wheel] || turn_rad != 0.0;
    speed_radps -= std::copysign(std::min(std::abs(speed_radps), drag_radps2_[wheel] * step_s_), speed_radps);
    if (drag_radps2_[wheel] == 0.0) speed_radps = 0.0;
    const double before = play_rad, moved = play_rad + turn_rad, free = moved - speed_radps * step_s_;
    play_rad = std::clamp(free, -over_rad_, 0.0);
    if (play_rad != free) speed_radps = turn_rad / step_s_;  // a flank carries it along
    const bool yields = over_rad_ > gap_rad_;                // it turns less while the play is crossed, and is held
    between_flanks_[wheel] = play_rad == free && gap_rad_ > 0.0 && !yields;
    turn_rad = yields ? turn_rad - gap_rad_ / over_rad_ * (play_rad - before) : moved - play_rad;
  }

  bool holds(Side side) const override { return !between_flanks_[side == Side::left ? 0 : 1]; }

 private:
  // Engaged in the direction in which it sets off, or midway.
  double at_the_start_rad(double turn_rad) const {
    if (*form_ == static_cast<int>(effects::kMiddleAtTheStart)) return -0.5 * over_rad_;
    return turn_rad > 0.0 ? 0.0 : -over_rad_;
  }

  std::string component_;
  double gap_rad_;
  std::optional<int> form_;
  double step_s_;
  double over_rad_;  // the turn over which the gap is crossed
  double drag_radps2_[2];
  double speed_radps_[2] = {0.0, 0.0};  // of the wheel
  bool has_begun_[2] = {false, false}, between_flanks_[2] = {false, false};
  double play_rad_[2] = {0.0, 0.0};  // 0: the motor pushes forward, -over: it pushes backward
};

}  // namespace

std::unique_ptr<Effect> drivetrain_backlash(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<DrivetrainBacklash>(active, machine);
}

}  // namespace odolab::planar
