#include "core/diagnosis/generic/swaying_truth.h"

#include <algorithm>
#include <utility>

#include "core/base/chi_square.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

// How far to either side a term carries the vehicle, in the direction in which it does so furthest; nothing where it
// turns it.
std::optional<double> carries_to_either_side_m(const JointModel& joint, const Effect& term,
                                               const std::vector<double>& value) {
  constexpr int kDirections = 36;
  double furthest_m = 0.0;
  for (const DriveView& view : joint.views()) {
    const Motions motion = motion_of(term, view, {}, value);
    std::vector<Vec2> gone_m{Vec2{}};
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const BodyMotion m = motion.at(i);
      if (m.turn_rad != 0.0) return std::nullopt;
      gone_m.push_back(gone_m.back() + Vec2{m.forward_m * s.cos_heading - m.sideways_m * s.sin_heading,
                                            m.forward_m * s.sin_heading + m.sideways_m * s.cos_heading});
    }
    for (int k = 0; k < kDirections; ++k) {
      const Vec2 towards = rotated({1.0, 0.0}, kPi * k / kDirections);
      double low_m = 0.0, high_m = 0.0;
      for (const Vec2& gone : gone_m) {
        const double at_m = dot(towards, gone);
        low_m = std::min(low_m, at_m), high_m = std::max(high_m, at_m);
      }
      furthest_m = std::max(furthest_m, 0.5 * (high_m - low_m));
    }
  }
  return furthest_m;
}

// A term where wheels turn; and beside it, with amplitudes of its own, where they rest.
std::shared_ptr<const Effect> in_parts(const std::shared_ptr<const Effect>& term, bool rests_too) {
  auto parts = std::make_shared<Effect>(*term);
  if (rests_too) parts->amplitudes.resize(2 * term->amplitudes.size());
  parts->motions = [=](const DriveView& view, const std::vector<double>& shape) {
    std::vector<Motions> driving = term->motions(view, shape), resting = driving;
    const std::vector<char> turning = view.turning();
    for (std::size_t k = 0; k < driving.size(); ++k)
      for (std::size_t i = driving[k].first(); i < driving[k].end(); ++i) (turning[i] ? resting : driving)[k][i] = {};
    if (rests_too) driving.insert(driving.end(), resting.begin(), resting.end());
    return driving;
  };
  return parts;
}

// The same, but for the rests, where these show that it acts only as the vehicle drives.
std::optional<GenericTest> as_it_drives(const GenericTest& t, const AskedModel& asked) {
  constexpr double kByChance = 0.05;
  GenericTest driving = t, both = t;
  ask(driving, asked, in_parts(t.as_effect, false), t.tests);
  if (driving.test.statistic < t.test.statistic + kClearlyBeaten) return std::nullopt;
  ask(both, asked, in_parts(t.as_effect, true), t.tests);
  const int more = both.test.freedom - driving.test.freedom;
  const double of_rests = (both.test.statistic - driving.test.statistic) / driving.test.inflation;
  if (more > 0 && chi_square_tail(of_rests, more) < kByChance) return std::nullopt;
  driving.variable += ", while it drives";
  return driving;
}

}  // namespace

void leave_to_swaying_truth(GenericTest& t, const AskedModel& asked) {
  const JointModel& joint = asked.joint;
  const double noise_m = joint.noise_as_recorded().truth_position_m;
  bool asked_of_rests = false;
  for (CandidateTest* of : {&t.test, &t.instead}) {
    if (of->value.empty() || t.p_value_of(*of) >= 1.0) continue;
    const std::optional<double> carries_m = carries_to_either_side_m(joint, *t.as_effect, of->value);
    if (!carries_m || *carries_m > noise_m) continue;
    if (!std::exchange(asked_of_rests, true))
      if (std::optional<GenericTest> driving = as_it_drives(t, asked)) {
        t = std::move(*driving);
        return;
      }
    if (of == &t.test) t.sway = {*carries_m, t.p_value_of(*of), *of};
    of->statistic = 0.0;
  }
  t.p_value = t.p_value_of(t.test);
}

}  // namespace odolab
