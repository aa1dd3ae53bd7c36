#include "core/diagnosis/naming/undone.h"

#include <cmath>

#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

// The truth's point and heading, moved by so much in the room between two times; shape {recording, from_s, to_s}.
Effect moved_for_a_while() {
  Effect e;
  e.name = "moved_for_a_while";
  e.component = "truth";
  e.amplitudes = {{"dx_m", "m"}, {"dy_m", "m"}, {"dheading_rad", "rad"}};
  e.local = e.of_one_recording = true;
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>(3);
    const std::size_t from = view.step_at(shape[1]), to = view.step_at(shape[2]);
    if (from >= to || to >= view.steps.size()) return std::vector<Motions>(3);
    const std::vector<Motions::Stretch> ends = {{from, from + 1}, {to, to + 1}};
    std::vector<Motions> m = {Motions(ends), Motions(ends), Motions(from, to + 1)};
    for (const auto& [i, sign] : {std::pair{from, 1.0}, std::pair{to, -1.0}}) {
      const double c = sign * view.steps[i].cos_heading, s = sign * view.steps[i].sin_heading;
      m[0][i] = {c, -s, 0.0};
      m[1][i] = {s, c, 0.0};
      m[2][i].turn_rad = sign;
    }
    // A heading that is said wrongly turns no way that is driven meanwhile.
    for (std::size_t i = from + 1; i < to; ++i) m[2][i].sideways_m = -view.steps[i].forward_m();
    return m;
  };
  return e;
}

}  // namespace

std::optional<Undone> undone(const JointModel& joint, const ScoredCandidate& c) {
  static const Effect away = moved_for_a_while();
  constexpr double kLasts_s[] = {0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5};
  constexpr double kAbout_s[] = {-0.1, 0.0, 0.1};
  const double tries = 2.0 * std::size(kLasts_s) * std::size(kAbout_s);
  if (!c.effect->local || !c.effect->of_one_recording) return std::nullopt;
  const double at_s = c.test.shape[1];
  CandidateTest best;
  for (const double about_s : kAbout_s)
    for (const double lasts_s : kLasts_s)
      for (const double begins_s : {at_s + about_s, at_s + about_s - lasts_s}) {
        const std::vector<double> shape = {c.test.shape[0], begins_s, begins_s + lasts_s};
        CandidateTest test = joint.test(joint.columns_of(away, shape));
        if (test.statistic <= best.statistic) continue;
        best = std::move(test);
        best.shape = shape;
      }
  if (best.statistic < c.test.statistic + kClearlyBeaten + 2.0 * std::log(tries)) return std::nullopt;
  return Undone{static_cast<int>(best.shape[0]), best.shape[1], best.shape[2], std::hypot(best.value[0], best.value[1]),
                best.value[2]};
}

}  // namespace odolab
