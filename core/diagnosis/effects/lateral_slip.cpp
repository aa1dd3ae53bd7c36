// Lateral slip: outwards, at a speed in proportion to the lateral acceleration v w. A rubber tyre runs at a slip angle
// that is in proportion to it (Pacejka, Tyre and Vehicle Dynamics, ch. 1): its sideways speed then grows with the speed
// as well. Where the side force grows with the sideways speed alone it takes the vehicle's mass as long to get there as
// the slip is seconds: k ds/dt = k v w - s, the force m s / k.
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {

Motions slipped_by(const DriveView& view, const LateralSlipForm& form) {
  Motions m;
  m.reserve(view.steps.size());
  double to_the_left_mps2 = 0.0;
  for (const EffectStep& s : view.steps) {
    const double share = form.settles_s > 0.0 ? 1.0 - std::exp(-s.duration_s / form.settles_s) : 1.0;
    to_the_left_mps2 += share * (-s.speed_mps * s.yaw_rate_radps - to_the_left_mps2);
    const double slip = to_the_left_mps2 * s.duration_s;
    m.push_back(BodyMotion{0.0, form.at_an_angle ? slip * std::abs(s.speed_mps) : slip, 0.0});
  }
  return m;
}

// What settles in as long as it slips, to within a factor of one and a half, and by more than whole counts feign.
bool settles_so(const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                const std::vector<DriveView>& views) {
  constexpr double kNear = 1.5;
  const LateralSlipForm& form = kLateralSlipForms[std::lround(shape.back())];
  if (form.settles_s == 0.0) return true;
  if (value[0] < form.settles_s / kNear || value[0] > form.settles_s * kNear) return false;
  return part_by_more_than_counts([&](const DriveView& view) { return slipped_by(view, form); },
                                  [](const DriveView& view) { return slipped_by(view, kLateralSlipForms[0]); },
                                  value[0], count_rad, views);
}

// At which slip at an angle is as large as slip that does not grow with the speed, by least squares.
double speed_of_bends_mps(const std::vector<DriveView>& views) {
  double squares = 0.0, by_speed = 1e-12;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) {
      const double square = std::pow(s.speed_mps * s.yaw_rate_radps, 2) * s.duration_s;
      squares += square;
      by_speed += square * std::abs(s.speed_mps);
    }
  return squares > 0.0 ? by_speed / squares : 0.0;
}

}  // namespace

std::vector<Effect> lateral_slip() {
  Effect e;
  e.name = "lateral_slip";
  e.component = "vehicle";
  e.amplitudes = {{"m_per_s_per_mps2", "s", 0.02, 0.0, 0.5}};
  for (const LateralSlipForm& form : kLateralSlipForms) e.forms.push_back(form.in_words);
  e.tests_of_a_shape = 0.6;  // but for how it begins and ends it is the same in all but one of them
  e.form_goes_with = settles_so;
  e.sentence = "in bends the vehicle slips outwards, in proportion to its lateral acceleration";
  e.regime = "in arcs, grows with speed times turn rate";
  e.looks_like = {"truth_mounting_offset", "tyre_compression"};
  e.told_apart_by = "arcs at two speeds or more, and turns on the spot";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    return motions_by_number(slipped_by(view, kLateralSlipForms[std::lround(shape.back())]));
  };
  e.stated_at_mps = [](const std::vector<double>& shape, const std::vector<DriveView>& views) {
    return kLateralSlipForms[std::lround(shape.back())].at_an_angle ? speed_of_bends_mps(views) : 0.0;
  };
  e.from_parameters = [](const ActiveEffect& a) {
    return std::vector<double>{a.parameter("m_per_s_per_mps2") / a.parameter(kStatedAt, 1.0)};
  };
  return {e};
}

}  // namespace odolab::effects
