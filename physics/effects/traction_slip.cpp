// A tyre that accelerates or brakes the vehicle slips: by a share of its speed in proportion to the acceleration.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

constexpr double kRelaxation_s = 0.03;  // the slip of a tyre builds up over some centimetres

class TractionSlip final : public Effect {
 public:
  TractionSlip(const ActiveEffect& a, double step_s)
      : component_(a.component), per_mps2_(a.parameter("per_mps2")), step_s_(step_s) {}

  void roll(const VehicleMotion&, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    Tyre& tyre = tyres_[wheel.side == Side::left ? 0 : 1];
    const double rim_mps = wheel.radius_m * wheel.speed_radps;
    const double due_m = 0.5 * per_mps2_ * rim_mps * std::abs(rim_mps);  // k abs(u) du/dt, from rest
    if (!tyre.rolled) tyre.slipped_m = due_m;                            // a replay may begin in motion
    tyre.rolled = true;
    // Slower where it slips much: a wheel whose slip grew as fast as its speed would have let go.
    const double builds_up_s = kRelaxation_s + std::max(0.0, per_mps2_) * std::abs(rim_mps);
    const double now_m = (1.0 - std::exp(-step_s_ / builds_up_s)) * (due_m - tyre.slipped_m);
    tyre.slipped_m += now_m;
    wheel.slip_mps += now_m / step_s_;
  }

 private:
  struct Tyre {
    bool rolled = false;
    double slipped_m = 0.0;
  };

  std::string component_;
  double per_mps2_, step_s_;
  Tyre tyres_[2];
};

}  // namespace

std::unique_ptr<Effect> traction_slip(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<TractionSlip>(active, machine.step_s);
}

}  // namespace odolab::planar
