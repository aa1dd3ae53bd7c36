// A tyre that accelerates or brakes the vehicle slips: by a share of its speed in proportion to the acceleration.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

constexpr double kRelaxation_s = 0.03;  // the slip of a tyre builds up over some centimetres

class TractionSlip final : public Effect {
 public:
  TractionSlip(const ActiveEffect& a, double step_s)
      : component_(a.component),
        per_mps2_(a.parameter("per_mps2")),
        step_s_(step_s),
        share_(1.0 - std::exp(-step_s / kRelaxation_s)) {}

  void roll(const VehicleMotion&, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    Tyre& tyre = tyres_[wheel.side == Side::left ? 0 : 1];
    const double rim_mps = wheel.radius_m * wheel.speed_radps;
    if (!tyre.rolled) tyre.rim_mps = rim_mps;  // a replay may begin in motion
    tyre.rolled = true;
    const double acceleration_mps2 = (rim_mps - tyre.rim_mps) / step_s_;
    tyre.slip_mps += share_ * (per_mps2_ * acceleration_mps2 * 0.5 * std::abs(rim_mps + tyre.rim_mps) - tyre.slip_mps);
    tyre.rim_mps = rim_mps;
    wheel.slip_mps += tyre.slip_mps;
  }

 private:
  struct Tyre {
    bool rolled = false;
    double rim_mps = 0.0;
    double slip_mps = 0.0;
  };

  std::string component_;
  double per_mps2_, step_s_, share_;
  Tyre tyres_[2];
};

}  // namespace

std::unique_ptr<Effect> traction_slip(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<TractionSlip>(active, machine.step_s);
}

}  // namespace odolab::planar
