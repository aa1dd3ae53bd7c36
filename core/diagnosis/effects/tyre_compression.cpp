// Tyre compression: with lateral acceleration a = v w the outer tyre is squeezed, and the inner one may be relieved, as
// the body rolls over.
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {

Motions squeezed_by(const DriveView& view, const TyreForm& form) {
  Motions m;
  m.reserve(view.steps.size());
  double a = 0.0;  // that the body has rolled over to; to the left: then the right wheel is outside
  for (const EffectStep& s : view.steps) {
    const double share = form.rolls_over_s > 0.0 ? 1.0 - std::exp(-s.duration_s / form.rolls_over_s) : 1.0;
    a += share * (s.speed_mps * s.yaw_rate_radps - a);
    const double left_m = (a < 0.0 ? 1.0 : form.inner_relieved) * a * s.left_by_rad;
    const double right_m = -(a > 0.0 ? 1.0 : form.inner_relieved) * a * s.right_by_rad;
    m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / view.drive.wheelbase_m});
  }
  return m;
}

// A body that rolls over slowly parts from one that does so at once by more than whole counts feign.
bool rolls_over_so(const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                   const std::vector<DriveView>& views) {
  const TyreForm& form = kTyreForms[std::lround(shape.back())];
  if (form.rolls_over_s == 0.0) return true;
  const TyreForm at_once{"", form.inner_relieved};
  return part_by_more_than_counts([&](const DriveView& view) { return squeezed_by(view, form); },
                                  [&](const DriveView& view) { return squeezed_by(view, at_once); }, value[0],
                                  count_rad, views);
}

}  // namespace

std::vector<Effect> tyre_compression() {
  Effect e;
  e.name = "tyre_compression";
  e.component = "both_wheels";
  e.amplitudes = {{"radius_change_m_per_mps2", "m/(m/s2)", 0.0003, 0.0, 0.03}};
  for (const TyreForm& form : kTyreForms) e.forms.push_back(form.in_words);
  e.tests_of_a_shape = 0.6;  // in long bends there are three of them
  e.form_goes_with = rolls_over_so;
  e.sentence = "load transfer in bends squeezes the outer tyre";
  e.regime = "in arcs, grows with speed times turn rate";
  e.looks_like = {"turn_scrub", "lateral_slip", "speed_dependent_radius"};
  e.told_apart_by = "one radius at two speeds, one speed at two radii, and turns on the spot";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    return motions_by_number(squeezed_by(view, kTyreForms[std::lround(shape.back())]));
  };
  return {e};
}

}  // namespace odolab::effects
