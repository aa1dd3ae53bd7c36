#include "core/diagnosis/generic/contradicted.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/calibration/between_readings.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/one_cause.h"
#include "core/diagnosis/naming/select.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

// Where the truth contradicts the wheels for so long that it is no outlier, with the noise of what does not: of each
// recording the stretches of time.
using Contradicted = std::vector<std::vector<std::pair<double, double>>>;

// While the vehicle stands, a truth that goes to and fro is its own: nothing of the wheels hides how its noise lasts.
constexpr double kStands_m = 0.05;  // of both wheels' way

double rolled_m(const DriveView& view, double from_s, double to_s) {
  double sum = 0.0;
  for (const EffectStep& s : view.steps)
    if (s.time_s > from_s && s.time_s < to_s) sum += std::abs(s.left_m) + std::abs(s.right_m);
  return sum;
}

Contradicted contradicted(const JointModel& joint, const FittedNoise& noise) {
  Contradicted of_run;
  for (int r = 0; r < static_cast<int>(joint.runs().size()); ++r) {
    InnovationModel model = joint.model_of(r);
    model.noise = noise;
    const InnovationRun run = joint.recorded(r);
    const TwoClocks clocks = joint.clocks(r);
    of_run.emplace_back();
    for (const auto& [first, last] : contradictions(run, summed_up(run, model), model))
      if (rolled_m(joint.views()[static_cast<std::size_t>(r)], clocks.wheels_stamp_s(run.truth[first].time_s),
                   clocks.wheels_stamp_s(run.truth[last].time_s)) > kStands_m)
        of_run.back().emplace_back(run.truth[first].time_s, run.truth[last].time_s);
  }
  return of_run;
}

int count(const Contradicted& of_run) {
  int places = 0;
  for (const auto& stretches : of_run) places += static_cast<int>(stretches.size());
  return places;
}

// When and where something happened once.
struct Moment {
  int run = 0;
  double at_s = 0.0;
  Vec2 place;
  std::optional<Vec2> bumped;  // of a bump: where its wheel stood, or the middle between both
};

Moment moment_of(const JointModel& joint, const AcceptedEffect& a) {
  const int run = static_cast<int>(a.shape[0]);
  const DriveView& view = joint.views()[static_cast<std::size_t>(run)];
  if (view.steps.empty()) return {run, a.shape[1], {}, std::nullopt};
  const std::size_t step = std::min(view.step_at(a.shape[1]), view.steps.size() - 1);
  const EffectStep& s = view.steps[step];
  Moment moment{run, a.shape[1], s.position, std::nullopt};
  const double side = a.effect->component == component_of(Wheel::left)    ? 0.5
                      : a.effect->component == component_of(Wheel::right) ? -0.5
                                                                          : 0.0;
  if (a.effect->name == "bump")
    moment.bumped = s.position + rotated({0.0, side * joint.model.drive.wheelbase_m}, s.heading_rad);
  return moment;
}

// Something on the floor that a wheel climbs once in its middle and once at its edge.
constexpr double kOneThing_m = 0.1;
bool are_one_bump(const Moment& a, const Moment& b) {
  return a.bumped && b.bumped && length(*a.bumped - *b.bumped) < kOneThing_m;
}

// The same of bumps that are met again and again, by where each lies.
bool are_one_bump(const AcceptedEffect& a, const AcceptedEffect& b) {
  const auto is_met_again = [](const AcceptedEffect& e) {
    return e.effect->name == "bump" && !e.effect->of_one_recording;
  };
  return is_met_again(a) && is_met_again(b) && !a.shape.empty() && !b.shape.empty() &&
         length(Vec2{a.shape[0], a.shape[1]} - Vec2{b.shape[0], b.shape[1]}) < kOneThing_m;
}

// Whether it is what was named before, once in each of other recordings: who is pushed in one may be in the next.
template <typename Names>
bool is_of_another_run(const AcceptedEffect& a, Names first, Names last) {
  bool any = false;
  for (; first != last; ++first) {
    if (first->effect->name != a.effect->name) continue;
    if (!a.effect->of_one_recording || !first->effect->of_one_recording || a.shape.empty() || first->shape.empty() ||
        a.shape[0] == first->shape[0])
      return false;
    any = true;
  }
  return any;
}

// What comes twice to one place, a wheel's breadth apart, is the floor's: nobody pushes there again.
constexpr double kOnePlace_m = 0.2;
bool are_at_one_place(const Moment& a, const Moment& b, double wheelbase_m) {
  constexpr double kAgain_s = 5.0;
  return (a.run != b.run || std::abs(a.at_s - b.at_s) > kAgain_s) &&
         length(a.place - b.place) < std::max(kOnePlace_m, wheelbase_m);
}

// So many times what noise makes, of squares, and further than chance takes it once in 60 000. A window counts as one
// number: what the wheels err by at its start moves its end to one side.
bool is_off(double square, double of_noise, int windows, double times) {
  constexpr double kByChance = 1.0 / 60000.0;
  return square >= times * of_noise && chi_square_tail(windows * square / of_noise, windows) < kByChance;
}

bool names_physics(const JointModel& named) {
  return std::any_of(named.accepted.begin(), named.accepted.end(), std::mem_fn(&AcceptedEffect::acts_on_motion));
}

// Of recordings from that one on what they err by over a metre, or radian, beyond so many times the noise; nothing
// where names take half of the squares away: what they leave is their form.
std::optional<JointModel::GatheredError> error_that_no_noise_makes(const JointModel& named,
                                                                   const JointModel& calibrated, int first_run,
                                                                   double times) {
  constexpr double kHalf = 0.5;  // of squares
  const JointModel::GatheredError error = named.gathered_error(first_run);
  if (error.windows == 0 || is_nothing(error)) return std::nullopt;
  const bool place_is_off = is_off(error.position_m2, error.noise_position_m2, error.windows, times),
             heading_is_off = is_off(error.heading_rad2, error.noise_heading_rad2, error.windows, times);
  if (!place_is_off && !heading_is_off) return std::nullopt;
  if (names_physics(named)) {
    const JointModel::GatheredError before = calibrated.gathered_error(first_run);
    if ((!place_is_off || error.position_m2 < kHalf * before.position_m2) &&
        (!heading_is_off || error.heading_rad2 < kHalf * before.heading_rad2))
      return std::nullopt;
  }
  return error;
}

std::string error_in_words(const JointModel::GatheredError& error) {
  return formatted("is off by %.2f mm and %.3f degrees over each metre or radian, where noise makes %.2f mm and %.3f",
                   1e3 * std::sqrt(error.position_m2), std::sqrt(error.heading_rad2) * 180.0 / kPi,
                   1e3 * std::sqrt(error.noise_position_m2), std::sqrt(error.noise_heading_rad2) * 180.0 / kPi);
}

}  // namespace

// Once may be a truth that found itself elsewhere. What names mend three quarters of is theirs; and what acts all the
// time, and lowers the squared error of dead reckoning by a tenth, is there whatever happened besides.
std::optional<Unnamed> what_contradicts(const JointModel& joint, const JointModel& calibrated,
                                        const FittedNoise& noise) {
  constexpr int kFewest = 2;
  constexpr double kLower = 0.9;
  const Contradicted now = contradicted(joint, noise);
  if (count(now) < kFewest) return std::nullopt;
  const bool acts_all_the_time = std::any_of(joint.accepted.begin(), joint.accepted.end(), [](const AcceptedEffect& a) {
    return !a.effect->local && a.acts_on_motion();
  });
  if (!joint.accepted.empty() && 4 * count(now) < count(contradicted(calibrated, noise))) return std::nullopt;
  if (acts_all_the_time && lowers(calibrated.gathered_error(), joint.gathered_error(), kLower)) return std::nullopt;
  Unnamed u;
  const auto most =
      std::max_element(now.begin(), now.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  u.where.recording = joint.runs()[static_cast<std::size_t>(most - now.begin())].name;
  u.where.time_s = *most;
  u.where.regime = "what the truth says contradicts the wheels, time and again, at " + std::to_string(count(now)) +
                   " places in all recordings";
  return u;
}

std::optional<Unnamed> what_was_not_foreseen(const JointModel& named, const JointModel& calibrated, int first_run) {
  constexpr double kTwice = 4.0;  // of squares
  const auto error = error_that_no_noise_makes(named, calibrated, first_run, kTwice);
  if (!error) return std::nullopt;
  Unnamed u;
  u.where.recording = named.runs()[static_cast<std::size_t>(first_run)].name;
  u.where.regime = "what was held out " + error_in_words(*error);
  return u;
}

std::optional<Unnamed> what_no_noise_makes(const JointModel& named, const JointModel& calibrated) {
  constexpr double kHalfAsMuchAgain = 2.0, kTwice = 4.0;  // of squares
  if (std::any_of(named.runs().begin(), named.runs().end(), is_read_seldom)) return std::nullopt;
  const auto error = error_that_no_noise_makes(named, calibrated, 0, names_physics(named) ? kTwice : kHalfAsMuchAgain);
  if (!error) return std::nullopt;
  Unnamed u;
  u.where.regime = "all along dead reckoning " + error_in_words(*error);
  return u;
}

// In the order of the recordings.
std::string in_words(std::vector<Moment> moments, const JointModel& joint) {
  std::sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) {
    return std::pair{a.run, a.at_s} < std::pair{b.run, b.at_s};
  });
  std::string words;
  for (const Moment& m : moments) {
    words += (words.empty() ? "" : ", ") + joint.runs()[static_cast<std::size_t>(m.run)].name +
             formatted(" at %.1f s", m.at_s);
  }
  return words;
}

std::optional<Unnamed> what_happens_too_often(const JointModel& joint) {
  Unnamed u;
  std::vector<Moment> moments;
  for (const AcceptedEffect& a : joint.accepted)
    if (a.effect->local && a.effect->of_one_recording) moments.push_back(moment_of(joint, a));
  for (const Moment& m : moments) u.where.time_s.emplace_back(m.at_s, m.at_s);
  if (joint.runs().size() > 1) u.where.time_s.clear();  // times of several recordings
  if (happened_once(joint) >= kTimeAndAgain) {
    u.where.regime = "what happens at " + std::to_string(moments.size()) +
                     " moments or more, each of which would be a push or a bump of its own (" +
                     in_words(moments, joint) + ")";
    return u;
  }
  if (moments.size() != 2 || !are_at_one_place(moments[0], moments[1], joint.model.drive.wheelbase_m) ||
      are_one_bump(moments[0], moments[1]))
    return std::nullopt;
  const Vec2 between = 0.5 * (moments[0].place + moments[1].place);
  u.where.zone = WhereFound::Zone{between.x_m, between.y_m, std::max(kOnePlace_m, joint.model.drive.wheelbase_m)};
  u.where.regime = "what happens at one place, otherwise each time that the vehicle comes there";
  return u;
}

std::optional<Unnamed> what_so_many_names_stand_for(const std::vector<AcceptedEffect>& names,
                                                    const std::vector<ScoredCandidate>& evidence) {
  constexpr std::size_t kMany = 3, kApart = 2;
  std::string words;
  std::vector<const Effect*> kinds;
  std::size_t count = 0, apart = 0;
  double weakest = kDecisive, gain = 0.0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const AcceptedEffect& a = names[k];
    if (!a.acts_on_motion()) continue;
    const double judged = evidence[k].test.judged();
    gain += judged;
    if (std::any_of(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const AcceptedEffect& before) { return are_one_bump(before, a); }))
      continue;
    words += (count++ > 0 ? ", " : "") + effect_words(a.effect->name);
    if (std::none_of(kinds.begin(), kinds.end(), [&](const Effect* e) { return e->name == a.effect->name; }))
      kinds.push_back(a.effect);
    if (!a.effect->local) continue;
    weakest = std::min(weakest, judged);
    if (is_of_another_run(a, names.begin(), names.begin() + static_cast<std::ptrdiff_t>(k))) continue;
    ++apart;
  }
  if (count < kMany || apart < kApart || kinds.size() < 2 || weakest >= kDecisive) return std::nullopt;
  Unnamed u;
  u.gain = gain;
  u.where.regime = "what would take " + std::to_string(count) + " causes at once (" + words + "), " +
                   std::to_string(apart) + " of them each at a place or a moment of its own";
  return u;
}

std::optional<Unnamed> what_scatters_too_much(const JointModel& joint) {
  constexpr double kMost_m_per_sqrt_m = 0.02;  // ten times what a rough floor does
  constexpr double kFewest_m = 1.0;            // that wheels must have rolled to show how they scatter
  constexpr double kTold_rad = 1.0;            // from half a turn
  const double scatter = joint.model.noise.wheel_m_per_sqrt_m;
  if (scatter < kMost_m_per_sqrt_m) return std::nullopt;
  double rolled_m = 0.0, samples = 0.0;
  for (const DriveView& view : joint.views())
    for (const EffectStep& s : view.steps) rolled_m += s.rolled_m();
  for (const InnovationRun& run : joint.runs()) samples += static_cast<double>(run.truth.size() - 1);
  if (rolled_m < kFewest_m) return std::nullopt;
  // Where headings are that uncertain from one sample to the next they may be off by whole turns, and their scatter is
  // no wheel's.
  const double heading_rad = scatter * std::sqrt(2.0 * rolled_m / samples) / joint.model.drive.wheelbase_m;
  if (heading_rad > kTold_rad) return std::nullopt;
  // Under a truth that errs by as much as wheels roll noise may have come to rest anywhere.
  constexpr double kPlainly = 10.0;
  FittedNoise most = joint.model.noise;
  most.wheel_m_per_sqrt_m = kMost_m_per_sqrt_m;
  JointModel scatters_less = joint.under(most);
  scatters_less.fit(3);
  if (likelier_by(joint, scatters_less) < kPlainly) return std::nullopt;
  Unnamed u;
  u.where.regime = formatted(
      "what the wheels say scatters by %.0f mm per root metre, more than any wheel does that rolls", 1e3 * scatter);
  return u;
}

}  // namespace odolab
