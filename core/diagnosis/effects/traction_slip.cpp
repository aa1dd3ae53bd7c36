// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/effect_motions.h"

namespace odolab::effects {

namespace {

// What a wheel pushes with is its share of the vehicle's mass times the vehicle's acceleration, and the moment of
// inertia's part of it where the vehicle turns more quickly: `of_turning` is that part beside what it would be if the
// mass stood over the wheels, 4 I / (m b^2), some 0.6 for a body as long as it is wide and 0 for a mast. `of_bends`:
// a mass that stands ahead of the axle by d is held in a bend by wheels that push unlike each other, by m d v w in all
// about the axle's middle: 2 d / b of the lateral acceleration at either wheel. `gives_way_s_per_mps`: a vehicle whose
// wheels slip speeds up by less than they do, s' = k v (a - s'') of the way s that is lost, so that s' stays behind
// k v a by k v; and by what a tyre's relaxation length takes (Pacejka, Tyre and Vehicle Dynamics, section 1.1).
struct TractionForm {
  const char* in_words;
  double of_turning, of_bends;
  std::optional<double> gives_way_s_per_mps = std::nullopt;
};
constexpr double kRelaxes_s = 0.03;
constexpr TractionForm kTractionForms[] = {
    {"each wheel by its own acceleration", 1.0, 0.0},
    {"the vehicle by its acceleration", 0.0, 0.0},
    {"each wheel by what it pushes of a body as long as it is wide", 0.6, 0.0},
    {"each wheel by its own acceleration, which it gives way to a little later", 1.0, 0.0, 0.0},
    {"each wheel by its own acceleration, which slip of 4 % per m/s2 holds back", 1.0, 0.0, 0.04},
    {"each wheel by its own acceleration, which slip of 8 % per m/s2 holds back", 1.0, 0.0, 0.08},
    {"each wheel by its own acceleration, which slip of 16 % per m/s2 holds back", 1.0, 0.0, 0.16},
    {"each wheel by what it pushes of a body whose mass stands ahead of the axle", 0.6, 0.3},
    {"each wheel by what it pushes of a body whose mass stands well ahead of the axle", 0.6, 0.6},
    {"each wheel by what it pushes of a body whose mass stands behind the axle", 0.6, -0.4},
};

struct Tyre {
  double owed = 0.0;  // way that is still to be lost, for one per m/s2

  double slip(double way_m, double acceleration_mps2, double duration_s, const TractionForm& form) {
    owed += std::abs(way_m) * acceleration_mps2;
    if (!form.gives_way_s_per_mps || duration_s <= 0.0) return std::exchange(owed, 0.0);
    const double behind_s = kRelaxes_s + *form.gives_way_s_per_mps * std::abs(way_m) / duration_s;
    const double lost = (1.0 - std::exp(-duration_s / behind_s)) * owed;
    owed -= lost;
    return lost;
  }
};

Motions lost_by(Wheel wheel, const DriveView& view, const TractionForm& form) {
  Motions m;
  m.reserve(view.steps.size());
  const double b = view.drive.wheelbase_m;
  Tyre left, right;
  for (const EffectStep& step : view.steps) {
    const double forward_mps2 = 0.5 * (step.left_mps2 + step.right_mps2);
    const double turning_mps2 = 0.5 * form.of_turning * (step.right_mps2 - step.left_mps2) +
                                form.of_bends * step.speed_mps * step.yaw_rate_radps;
    const auto lost_m = [&](Tyre& tyre, double way_m, double turning) {
      return tyre.slip(way_m, forward_mps2 + turning, step.duration_s, form);
    };
    const double left_m = wheel == Wheel::right ? 0.0 : -lost_m(left, step.left_m, -turning_mps2);
    const double right_m = wheel == Wheel::left ? 0.0 : -lost_m(right, step.right_m, turning_mps2);
    m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / b});
  }
  return m;
}

// What stays behind by as much as it slips, to within a factor of two, and by more than whole counts feign.
bool stays_behind_so(const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                     const std::vector<DriveView>& views) {
  const TractionForm& form = kTractionForms[std::lround(shape.back())];
  const double by = form.gives_way_s_per_mps.value_or(0.0);
  if (by == 0.0) return true;
  if (value[0] < 0.5 * by || value[0] > 2.0 * by) return false;
  return part_by_more_than_counts([&](const DriveView& view) { return lost_by(Wheel::both, view, form); },
                                  [](const DriveView& view) { return lost_by(Wheel::both, view, kTractionForms[0]); },
                                  value[0], count_rad, views);
}

Effect slip_of(Wheel wheel) {
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
    for (const TractionForm& form : kTractionForms) e.forms.push_back(form.in_words);
    e.tests_of_a_shape = 0.6;  // on straights they are the same
    e.form_goes_with = stays_behind_so;
  }
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    return motions_by_number(
        lost_by(wheel, view, kTractionForms[wheel == Wheel::both ? std::lround(shape.back()) : 0]));
  };
  return e;
}

}  // namespace

std::vector<Effect> traction_slip() { return {slip_of(Wheel::both), slip_of(Wheel::left), slip_of(Wheel::right)}; }

}  // namespace odolab::effects
