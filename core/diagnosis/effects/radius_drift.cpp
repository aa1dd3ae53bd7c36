// Wheels that grow or shrink with time: warming, wear, pressure. The share of the radius is per_s times the time: since
// each recording's start, or on through the session where recordings are stamped by one clock and wheels did not cool
// between. What warms does so towards an end, Newton's law of cooling: then per_s is the rate at which it begins. Work
// warms tyres, and rolling wears and dries them: that goes by the way, and per_s is the rate at the mean pace.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {
constexpr std::size_t kFrom = 0, kForm = 1;  // of a shape
constexpr int kByWay = 5;                    // of the forms
static_assert(kDriftForms[kByWay].by_way && kDriftForms[kByWay].way_constant_m == 0.0);

const DriftForm& drift_form(const std::vector<double>& shape) {
  return kDriftForms[shape.size() > kForm ? std::lround(shape[kForm]) : 0];
}

// For a value of one: of the left wheel's radius and of the right one's, in each step.
class Drifted {
 public:
  Drifted(const DriftForm& form, double from_s) : form_(form), from_s_(from_s) {}

  std::pair<double, double> at(const EffectStep& s) {
    if (!form_.by_way) {
      const double t = drifted(form_.through_the_session ? s.time_s - from_s_ : s.since_start_s, form_.time_constant_s);
      return {t, t};
    }
    left_m_ += std::abs(s.left_m), right_m_ += std::abs(s.right_m);
    return {drifted(left_m_, form_.way_constant_m), drifted(right_m_, form_.way_constant_m)};
  }

 private:
  const DriftForm& form_;
  double from_s_, left_m_ = 0.0, right_m_ = 0.0;
};

// Of either wheel, rests and all.
double mean_pace_mps(const std::vector<DriveView>& views) {
  double way_m = 0.0, time_s = 0.0;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps)
      way_m += s.rolled_m(), time_s += s.duration_s;
  return time_s > 0.0 ? way_m / time_s : 0.0;
}

Effect drift_of(Wheel wheel) {
  Effect e;
  e.name = "radius_drift";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_s", "1/s", 1e-4, -0.01, 0.01}};
  e.shapes = {{kSessionStart, "s"}};  // from when on time counts in a session
  for (const DriftForm& form : kDriftForms) {
    e.forms.push_back(form.in_words);
    e.simpler_form.push_back(form.through_the_session ? 1 : form.way_constant_m > 0.0 ? kByWay : 0);  // for ever
  }
  e.tests_of_a_shape = 0.2;  // what grows with time does so in all forms
  e.sentence = std::string("the radius of the ") +
               (wheel == Wheel::left    ? "left wheel"
                : wheel == Wheel::right ? "right wheel"
                                        : "wheels") +
               " drifts with time";
  e.regime = "grows with the time, or the way, since the start";
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
    Drifted drifted(drift_form(shape), shape[kFrom]);
    Motions m;
    for (const EffectStep& s : view.steps) {
      const auto [left, right] = drifted.at(s);
      const double left_m = wheel == Wheel::right ? 0.0 : left * s.left_m,
                   right_m = wheel == Wheel::left ? 0.0 : right * s.right_m;
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / view.drive.wheelbase_m});
    }
    return motions_by_number(std::move(m));
  };
  e.stated_at_mps = [](const std::vector<double>& shape, const std::vector<DriveView>& views) {
    return drift_form(shape).by_way ? mean_pace_mps(views) : 0.0;
  };
  e.from_parameters = [](const ActiveEffect& a) {
    return std::vector<double>{a.parameter("per_s") / a.parameter(kStatedAt, 1.0)};
  };
  return e;
}
}  // namespace

bool drifts_through_the_session(int form) { return kDriftForms[form].through_the_session; }

double drift_time_constant_s(int form) { return kDriftForms[form].time_constant_s; }

std::vector<Effect> radius_drift() { return {drift_of(Wheel::both), drift_of(Wheel::left), drift_of(Wheel::right)}; }

}  // namespace odolab::effects
