// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>
#include <string>
#include <utility>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/effects/forms.h"
#include "core/diagnosis/effects/yielding_tread.h"

namespace odolab::effects {

namespace {

struct Tyre {
  double radius_m = 0.0;
  double owed = 0.0;         // way that is still to be lost, for one per m/s2
  double slips_mps2 = 0.0;   // the acceleration that its slip has come to
  double before_mps2 = 0.0;  // that of the step before
  YieldingTread tread = {};

  double slip(double way_m, double acceleration_mps2, double duration_s, const TractionForm& form) {
    if (form.gives_way_s_per_mps && form.yields_radii > 0.0)
      return tread.stays_behind_m(way_m, acceleration_mps2, duration_s, radius_m, form);
    const double builds_up_m = form.builds_up_radii * radius_m;
    const double built_up = builds_up_m > 0.0 ? 1.0 - std::exp(-std::abs(way_m) / builds_up_m) : 1.0;
    slips_mps2 += built_up * (acceleration_mps2 - slips_mps2);
    owed += std::abs(way_m) * slips_mps2;
    owed += form.yields_radii * radius_m * (acceleration_mps2 - std::exchange(before_mps2, acceleration_mps2));
    if (!form.gives_way_s_per_mps || duration_s <= 0.0) return std::exchange(owed, 0.0);
    const double behind_s = kTyreRelaxes_s + *form.gives_way_s_per_mps * std::abs(way_m) / duration_s;
    const double lost = (1.0 - std::exp(-duration_s / behind_s)) * owed;
    owed -= lost;
    return lost;
  }
};

Motions lost_by(Wheel wheel, const DriveView& view, const TractionForm& form) {
  // A base that swings about what it was told has a loop that does.
  if (view.from_commands && (form.yields_radii > 0.0 || form.builds_up_radii > 0.0)) return {};
  Motions m;
  m.reserve(view.steps.size());
  const double b = view.drive.wheelbase_m;
  Tyre left{view.drive.wheel_radius_left_m}, right{view.drive.wheel_radius_right_m};
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

// What slip holds back stays behind by as much as it slips, to within a factor of two. And any form of its own parts
// from the catalogue's by more than whole counts feign.
bool stays_behind_so(const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                     const std::vector<DriveView>& views) {
  const TractionForm& form = kTractionForms[std::lround(shape.back())];
  const double by = form.gives_way_s_per_mps.value_or(0.0);
  constexpr double kLittle_s_per_mps = 0.02;  // what less holds back is nearly none
  if (by > 0.0 && (value[0] > 2.0 * by || (value[0] < 0.5 * by && by > kLittle_s_per_mps))) return false;
  if (by == 0.0 && form.yields_radii == 0.0 && form.builds_up_radii == 0.0) return true;
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
