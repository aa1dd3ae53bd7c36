// In a turn the load moves to the outer wheel and squeezes its tyre, as the body rolls over.
#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TyreCompression final : public Effect {
 public:
  TyreCompression(const ActiveEffect& a, double step_s)
      : component_(a.component),
        change_m_per_mps2_(a.parameter("radius_change_m_per_mps2")),
        form_(effects::kTyreForms[form_of(a).value_or(0)]),
        share_(form_.rolls_over_s > 0.0 ? 1.0 - std::exp(-step_s / form_.rolls_over_s) : 1.0) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    double& rolled_mps2 = rolled_mps2_[wheel.side == Side::left ? 0 : 1];  // to the left: then the right one is outside
    rolled_mps2 += share_ * (motion.speed_mps * motion.yaw_rate_radps - rolled_mps2);
    if (!acts_on(component_, wheel.side)) return;
    const bool outside = rolled_mps2 > 0.0 ? wheel.side == Side::right : wheel.side == Side::left;
    wheel.radius_m += change_m_per_mps2_ * std::abs(rolled_mps2) * (outside ? -1.0 : form_.inner_relieved);
  }

 private:
  std::string component_;
  double change_m_per_mps2_;
  effects::TyreForm form_;
  double share_;
  double rolled_mps2_[2] = {};  // what the body has rolled over to, as either wheel is asked
};

}  // namespace

std::unique_ptr<Effect> tyre_compression(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<TyreCompression>(active, machine.step_s);
}

}  // namespace odolab::planar
