#include "core/diagnosis/naming/undone.h"

#include <algorithm>
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

// What a push says at that moment, in the form in which it says most: a bump is a push that knows where it goes.
double pushed_by(const CandidateScan& scan, std::vector<double> moment) {
  const Effect& push = push_from_outside();
  moment.resize(2);
  double most = 0.0;
  for (std::size_t form = 0; form < push.forms.size(); ++form)
    most = std::max(most, scan.test(push, {moment[0], moment[1], static_cast<double>(form)}).statistic);
  return most;
}

constexpr double kAwayFor_s[] = {0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5};
constexpr double kAwayAbout_s[] = {-0.1, 0.0, 0.1};

}  // namespace

const Effect& push_from_outside() {
  return *std::find_if(catalogue().begin(), catalogue().end(), [](const Effect& e) { return e.name == "collision"; });
}

double away_by_chance() { return 2.0 * std::log(2.0 * std::size(kAwayFor_s) * std::size(kAwayAbout_s)); }

CandidateTest away_for_a_while(const CandidateScan& scan, int run, double at_s) {
  static const Effect away = moved_for_a_while();
  CandidateTest best;
  for (const double about_s : kAwayAbout_s)
    for (const double lasts_s : kAwayFor_s)
      for (const double begins_s : {at_s + about_s, at_s + about_s - lasts_s}) {
        const std::vector<double> shape = {static_cast<double>(run), begins_s, begins_s + lasts_s};
        CandidateTest test = scan.test(away, shape);
        if (test.statistic <= best.statistic) continue;
        best = std::move(test);
        best.shape = shape;
      }
  return best;
}

std::optional<Undone> undone(const JointModel& joint, const ScoredCandidate& c) {
  if (!c.effect->local || !c.effect->of_one_recording) return std::nullopt;
  const CandidateScan scan(joint);
  const CandidateTest away = away_for_a_while(scan, static_cast<int>(c.test.shape[0]), c.test.shape[1]);
  const double stays = std::max(c.test.statistic, pushed_by(scan, c.test.shape));
  if (away.statistic < stays + kClearlyBeaten + away_by_chance()) return std::nullopt;
  // It goes, and comes back, within a step each: samples of these are off, too.
  const auto run = static_cast<int>(away.shape[0]);
  const DriveView& view = joint.views()[static_cast<std::size_t>(run)];
  const EffectStep &goes = view.steps[view.step_at(away.shape[1])], &returns = view.steps[view.step_at(away.shape[2])];
  return Undone{run, std::min(away.shape[1], goes.time_s - 0.5 * goes.duration_s),
                std::max(away.shape[2], returns.time_s + 0.5 * returns.duration_s),
                std::hypot(away.value[0], away.value[1]), away.value[2]};
}

}  // namespace odolab
