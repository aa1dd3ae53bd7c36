// Tyres hold a side force only by creeping sideways. As a damper between vehicle and floor, force = m / k * creep, the
// creep settles with the time constant k itself; taken as an equation of its own it stays stable at any step.
#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class LateralSlip final : public Effect {
 public:
  LateralSlip(const ActiveEffect& a, double step_s) : coefficient_s_(a.parameter("m_per_s_per_mps2")) {
    const std::optional<int> form = form_of(a);
    const double settles_s = form ? effects::kLateralSlipForms[*form].settles_s : std::abs(coefficient_s_);
    at_an_angle_ = form && effects::kLateralSlipForms[*form].at_an_angle;
    if (at_an_angle_) coefficient_s_ /= a.parameter("at_mps", 1.0);
    share_ = settles_s > 0.0 ? 1.0 - std::exp(-step_s / settles_s) : form ? 1.0 : 0.0;
  }

  void creep(const VehicleMotion& motion, Creep& creep) override {
    const double lateral_mps2 = motion.speed_mps * motion.yaw_rate_radps;
    outward_mps_ +=
        share_ * (coefficient_s_ * lateral_mps2 * (at_an_angle_ ? std::abs(motion.speed_mps) : 1.0) - outward_mps_);
    creep.velocity_mps.y_m -= outward_mps_;  // away from the centre of the turn
  }

 private:
  double coefficient_s_, share_;
  bool at_an_angle_;  // in proportion to the lateral acceleration: the creep grows with the speed as well
  double outward_mps_ = 0.0;
};

}  // namespace

std::unique_ptr<Effect> lateral_slip(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<LateralSlip>(active, machine.step_s);
}

}  // namespace odolab::planar
