// A tyre that accelerates or brakes the vehicle slips: by a share of its speed in proportion to the acceleration.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/forms.h"
#include "core/diagnosis/effects/yielding_tread.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// Slower where it slips much: a wheel whose slip grew as fast as its speed would have let go.
double builds_up_in_s(double per_mps2, double rim_mps) {
  return effects::kTyreRelaxes_s + std::max(0.0, per_mps2) * std::abs(rim_mps);
}

// As a tyre's slip builds up. Each wheel by its own acceleration.
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
    const double builds_up_s = builds_up_in_s(per_mps2_, rim_mps);
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

// By what each wheel pushes, in one of the forms: of a step the way abs(u) du.
class TractionSlipInForm final : public Effect {
 public:
  TractionSlipInForm(const ActiveEffect& a, int form, const Machine& machine)
      : component_(a.component),
        per_mps2_(a.parameter("per_mps2")),
        form_(effects::kTractionForms[form]),
        half_base_m_(0.5 * machine.actual.wheelbase_m),
        step_s_(machine.step_s) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    const bool is_left = wheel.side == Side::left;
    Tyre& tyre = tyres_[is_left ? 0 : 1];
    const double rim_mps = wheel.radius_m * wheel.speed_radps,
                 turning_mps = half_base_m_ * motion.rolled_yaw_rate_radps;
    const bool swings = form_.gives_way_s_per_mps && form_.yields_radii > 0.0;
    if (swings) {
      const double speeds_up_mps = tyre.rolled ? rim_mps - tyre.rim_mps : 0.0;
      tyre.owed_m += per_mps2_ * tyre.tread.stays_behind_m(rim_mps * step_s_, speeds_up_mps / step_s_, step_s_,
                                                           wheel.radius_m, form_);
    } else if (tyre.rolled) {  // a replay may begin in motion
      const double quicker_mps = form_.of_turning * (turning_mps - tyre.turning_mps) +
                                 form_.of_bends * motion.speed_mps * motion.yaw_rate_radps * step_s_;
      const double pushed_mps = motion.rolled_speed_mps - tyre.speed_mps + (is_left ? -quicker_mps : quicker_mps),
                   rolled_mps = 0.5 * (std::abs(rim_mps) + std::abs(tyre.rim_mps)),
                   builds_up_m = form_.builds_up_radii * wheel.radius_m,
                   built_up = builds_up_m > 0.0 ? 1.0 - std::exp(-rolled_mps * step_s_ / builds_up_m) : 1.0;
      tyre.slips_mps += built_up * (pushed_mps - tyre.slips_mps);
      tyre.owed_m += per_mps2_ * rolled_mps * tyre.slips_mps;
      // A tread that was deflected within one step would let go of the floor.
      const double more_mps = (1.0 - std::exp(-step_s_ / effects::kTyreRelaxes_s)) * (pushed_mps - tyre.pushed_mps);
      tyre.owed_m += per_mps2_ * form_.yields_radii * wheel.radius_m * more_mps / step_s_;
      tyre.pushed_mps += more_mps;
    }
    tyre.rolled = true;
    tyre.rim_mps = rim_mps;
    tyre.speed_mps = motion.rolled_speed_mps;
    tyre.turning_mps = turning_mps;
    double builds_up_s = form_.gives_way_s_per_mps && !swings
                             ? effects::kTyreRelaxes_s + *form_.gives_way_s_per_mps * std::abs(rim_mps)
                             : 0.0;
    // A wheel whose motor feels the slip would let go of the floor by what it loses at once.
    if (wheel.yields) builds_up_s = std::max(builds_up_s, builds_up_in_s(per_mps2_, rim_mps));
    const double share = builds_up_s > 0.0 ? 1.0 - std::exp(-step_s_ / builds_up_s) : 1.0;
    wheel.slip_mps += share * tyre.owed_m / step_s_;
    tyre.owed_m -= share * tyre.owed_m;
  }

 private:
  struct Tyre {
    bool rolled = false;
    double rim_mps = 0.0, speed_mps = 0.0, turning_mps = 0.0;  // in the step before
    double pushed_mps = 0.0, slips_mps = 0.0;                  // what its deflection and its slip have come to
    double owed_m = 0.0;                                       // way that is still to be lost
    effects::YieldingTread tread;
  };

  std::string component_;
  double per_mps2_;
  effects::TractionForm form_;
  double half_base_m_, step_s_;
  Tyre tyres_[2];
};

}  // namespace

std::unique_ptr<Effect> traction_slip(const ActiveEffect& active, const Machine& machine) {
  if (const std::optional<int> form = form_of(active))
    return std::make_unique<TractionSlipInForm>(active, *form, machine);
  return std::make_unique<TractionSlip>(active, machine.step_s);
}

}  // namespace odolab::planar
