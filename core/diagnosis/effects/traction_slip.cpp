// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>
#include <string>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

// What a wheel pushes with is its share of the vehicle's mass times the vehicle's acceleration, and the moment of
// inertia's part of it where the vehicle turns more quickly: `of_turning` is that part beside what it would be if the
// mass stood over the wheels, 4 I / (m b^2), some 0.6 for a body as long as it is wide and 0 for a mast. `of_bends`:
// a mass that stands ahead of the axle by d is held in a bend by wheels that push unlike each other, by m d v w in all
// about the axle's middle: 2 d / b of the lateral acceleration at either wheel. `lag_s`: what a tyre's relaxation
// length takes (Pacejka, Tyre and Vehicle Dynamics, section 1.1).
struct Form {
  const char* in_words;
  double of_turning, of_bends, lag_s;
};
constexpr Form kForms[] = {
    {"each wheel by its own acceleration", 1.0, 0.0, 0.0},
    {"the vehicle by its acceleration", 0.0, 0.0, 0.0},
    {"each wheel by what it pushes of a body as long as it is wide", 0.6, 0.0, 0.0},
    {"each wheel by its own acceleration, which it gives way to a little later", 1.0, 0.0, 0.03},
    {"each wheel by what it pushes of a body whose mass stands ahead of the axle", 0.6, 0.3, 0.0},
    {"each wheel by what it pushes of a body whose mass stands well ahead of the axle", 0.6, 0.6, 0.0},
    {"each wheel by what it pushes of a body whose mass stands behind the axle", 0.6, -0.4, 0.0},
};

struct Tyre {
  double slips_by_mps2 = 0.0;

  double slip_m(double way_m, double acceleration_mps2, double duration_s, double lag_s) {
    const double share = lag_s > 0.0 ? 1.0 - std::exp(-duration_s / lag_s) : 1.0;
    slips_by_mps2 += share * (acceleration_mps2 - slips_by_mps2);
    return slips_by_mps2 * std::abs(way_m);
  }
};

Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "traction_slip";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_mps2", "1/(m/s2)", 0.01, 0.0, 0.3}};
  e.sentence = std::string(wheel == Wheel::both   ? "the wheels slip when they push"
                           : wheel == Wheel::left ? "the left wheel slips when it pushes"
                                                  : "the right wheel slips when it pushes") +
               ": more turning than travel while accelerating, less while braking";
  e.regime = "while accelerating and braking";
  e.looks_like = {"clock_rate", "truth_time_offset", "drivetrain_backlash", "actuator_lag"};
  e.told_apart_by = "hard braking against hard accelerating, forwards and in reverse";
  if (wheel == Wheel::both) {
    for (const Form& form : kForms) e.forms.push_back(form.in_words);
    e.tests_of_a_shape = 0.6;  // on straights they are the same
  }
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    const double b = view.drive.wheelbase_m;
    const Form& form = kForms[wheel == Wheel::both ? std::lround(shape.back()) : 0];
    Tyre left, right;
    for (const EffectStep& step : view.steps) {
      const double forward_mps2 = 0.5 * (step.left_mps2 + step.right_mps2);
      const double turning_mps2 = 0.5 * form.of_turning * (step.right_mps2 - step.left_mps2) +
                                  form.of_bends * step.speed_mps * step.yaw_rate_radps;
      const auto lost_m = [&](Tyre& tyre, double way_m, double turning) {
        return tyre.slip_m(way_m, forward_mps2 + turning, step.duration_s, form.lag_s);
      };
      const double left_m = wheel == Wheel::right ? 0.0 : -lost_m(left, step.left_m, -turning_mps2);
      const double right_m = wheel == Wheel::left ? 0.0 : -lost_m(right, step.right_m, turning_mps2);
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / b});
    }
    return std::vector<Motions>{m};
  };
  return e;
}

}  // namespace

std::vector<Effect> traction_slip() { return {of_wheel(Wheel::both), of_wheel(Wheel::left), of_wheel(Wheel::right)}; }

}  // namespace odolab::effects
