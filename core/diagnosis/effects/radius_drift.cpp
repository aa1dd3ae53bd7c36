// Wheels that grow or shrink with time: warming, wear, pressure. The share of the radius is per_s times the time: since
// each recording's start, or on through the session where recordings are stamped by one clock and wheels did not cool
// between. What warms does so towards an end, Newton's law of cooling: then per_s is the rate at which it begins.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {
constexpr std::size_t kFrom = 0, kForm = 1;  // of a shape

const DriftForm& form_of(const std::vector<double>& shape) {
  return kDriftForms[shape.size() > kForm ? std::lround(shape[kForm]) : 0];
}

Effect drift_of(Wheel wheel) {
  Effect e;
  e.name = "radius_drift";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_s", "1/s", 1e-4, -0.01, 0.01}};
  e.shapes = {{kSessionStart, "s"}};  // from when on time counts in a session
  for (const DriftForm& form : kDriftForms) {
    e.forms.push_back(form.in_words);
    e.simpler_form.push_back(form.through_the_session ? 1 : 0);  // for ever
  }
  e.tests_of_a_shape = 0.3;  // what grows with time does so in all forms
  e.sentence = std::string("the radius of the ") +
               (wheel == Wheel::left    ? "left wheel"
                : wheel == Wheel::right ? "right wheel"
                                        : "wheels") +
               " drifts with time";
  e.regime = "grows with the time since the start";
  e.looks_like = {"one_sided_drag", "payload_radius_change", "clock_rate"};
  e.told_apart_by = "the same straight early and late in a long run";
  e.scan = [](const std::vector<DriveView>& views) {
    double first_s = kUnbounded;
    for (const DriveView& view : views)
      if (!view.steps.empty()) first_s = std::min(first_s, view.steps[0].time_s);
    if (first_s == kUnbounded) first_s = 0.0;
    return std::vector<std::vector<double>>{{first_s}};
  };
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    const DriftForm& form = form_of(shape);
    Motions m;
    for (const EffectStep& s : view.steps) {
      const double t =
          drifted_s(form.through_the_session ? s.time_s - shape[kFrom] : s.since_start_s, form.time_constant_s);
      if (wheel == Wheel::both)
        m.push_back({t * s.forward_m(), 0.0, t * s.turn_rad});
      else
        m.push_back(by_wheel(wheel, t * (wheel == Wheel::left ? s.left_m : s.right_m), view.drive.wheelbase_m));
    }
    return motions_by_number(std::move(m));
  };
  return e;
}
}  // namespace

double drifted_s(double since_s, double time_constant_s) {
  return time_constant_s > 0.0 ? time_constant_s * -std::expm1(-since_s / time_constant_s) : since_s;
}

bool drifts_through_the_session(int form) { return kDriftForms[form].through_the_session; }

double drift_time_constant_s(int form) { return kDriftForms[form].time_constant_s; }

std::vector<Effect> radius_drift() { return {drift_of(Wheel::both), drift_of(Wheel::left), drift_of(Wheel::right)}; }

}  // namespace odolab::effects
