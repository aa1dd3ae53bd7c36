// A push from outside: a step of the pose, in the floor's frame, at one time of one recording.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

std::vector<Effect> collision() {
  Effect e;
  e.name = "collision";
  e.component = "vehicle";
  e.amplitudes = {
      {"dx_m", "m", 0.02, -2.0, 2.0}, {"dy_m", "m", 0.02, -2.0, 2.0}, {"dheading_rad", "rad", 0.03, -4.0, 4.0}};
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.forms = {"at once", "within 0.25 s", "within 0.5 s"};
  e.sentence = "something pushed the vehicle: its pose jumps while the wheels know nothing of it";
  e.regime = "at one moment";
  e.looks_like = {"bump", "truth_frozen"};
  e.told_apart_by = "the same way driven again: a push does not come back";
  e.tests_of_a_shape = 0.5;  // moments 0.12 s apart are one, in whichever form, as long as the truth errs
  e.local = true;
  e.forms_of_the_scan = {1};  // half of the others' length is found by both
  e.of_one_recording = true;
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>(3);
    const double lasts_s = kCollisionLasts_s[static_cast<int>(shape.back())];
    double total_s = 0.0;
    // How much of the way is done: it begins and ends softly, and `at_s` is its middle. At least the interval in which
    // that lies.
    const double begins_s = shape[1] - 0.5 * lasts_s;
    const auto done = [&](double t) {
      return 0.5 - 0.5 * std::cos(kPi * std::clamp((t - begins_s) / lasts_s, 0.0, 1.0));
    };
    const auto within = [&](const EffectStep& s) {
      const double from = s.time_s - 0.5 * s.duration_s, to = s.time_s + 0.5 * s.duration_s;
      if (lasts_s <= 0.0) return shape[1] > from - 1e-9 && shape[1] <= to + 1e-9 && total_s == 0.0 ? to - from : 0.0;
      return to < begins_s || from > begins_s + lasts_s ? 0.0 : done(to) - done(from);
    };
    std::vector<std::pair<std::size_t, double>> acts;
    const std::size_t at = view.step_at(begins_s);
    for (std::size_t i = at > 0 ? at - 1 : 0; i < view.steps.size(); ++i) {
      if (view.steps[i].time_s - 0.5 * view.steps[i].duration_s > begins_s + lasts_s) break;
      if (const double share = within(view.steps[i]); share > 0.0) {
        acts.emplace_back(i, share);
        total_s += share;
      }
    }
    if (acts.empty()) return std::vector<Motions>(3);
    std::vector<Motions> m(3, Motions(acts.front().first, acts.back().first + 1));
    for (const auto& [i, share] : acts) {
      const double c = view.steps[i].cos_heading, s = view.steps[i].sin_heading, part = share / total_s;
      m[0][i] = {part * c, -part * s, 0.0};
      m[1][i] = {part * s, part * c, 0.0};
      m[2][i].turn_rad = part;
    }
    return m;
  };
  e.scan = [](const std::vector<DriveView>& views) {
    return moments(views, 0.12, [](const EffectStep&) { return true; });
  };
  return {e};
}

}  // namespace odolab::effects
