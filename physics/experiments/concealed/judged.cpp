#include "physics/experiments/concealed/judged.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/diagnosis/fitted_model.h"
#include "core/io/number_text.h"
#include "core/odometry/prediction.h"
#include "physics/experiments/concealed/concealment.h"
#include "physics/experiments/concealed/oracle.h"

namespace odolab::concealed {

namespace {

std::string label(const std::string& effect, const std::string& component) {
  if (effect == "unknown") return effect;
  return component == "left_wheel" || component == "right_wheel" ? effect + "." + component : effect;
}

std::string label(const ActiveEffect& active) { return label(active.effect, active.component); }

bool contains(const std::vector<std::string>& list, const std::string& one) {
  return std::find(list.begin(), list.end(), one) != list.end();
}

void judge_names(Judged& j, const Diagnosis& d) {
  for (const Finding& f : d.findings) {
    j.found.push_back(label(f.effect, f.component));
    if (j.found.size() == 1) j.regime = f.where.regime;
    if (j.found.size() == 1)
      for (const Alternative& a : f.alternatives) j.listed.push_back(label(a.effect, a.component));
    if (f.effect != "unknown" && f.alternatives.empty() && !contains(j.truth, j.found.back())) j.wrong_alone = true;
  }
  const bool named = d.verdict != Verdict::unknown_effect && !j.found.empty();
  j.named_first = named && contains(j.truth, j.found.front());
  j.named_all =
      named && std::all_of(j.truth.begin(), j.truth.end(), [&](const std::string& t) { return contains(j.found, t); });
  j.only_those = j.named_all && std::all_of(j.found.begin(), j.found.end(),
                                            [&](const std::string& f) { return contains(j.truth, f); });
  j.truth_listed =
      std::any_of(j.listed.begin(), j.listed.end(), [&](const std::string& a) { return contains(j.truth, a); });
}

// The true value of a parameter of a finding; none where the two are not the same thing.
std::optional<double> true_value(const DrawnEffect& e, const std::string& name) {
  if (e.active.effect == "collision" && (name == "dx_m" || name == "dy_m")) return std::nullopt;  // frames differ
  if (e.only_in_run >= 0 && name == "at_s") return e.active.parameter("at_s");
  for (const auto& [key, value] : e.active.parameters)
    if (key == name) return value;
  return std::nullopt;
}

void judge_parameters(Judged& j, const DrawnCase& c, const Diagnosis& d) {
  for (const Finding& f : d.findings)
    for (const DrawnEffect& e : c.effects) {
      if (label(f.effect, f.component) != label(e.active)) continue;
      for (const FoundParameter& p : f.parameters) {
        const std::optional<double> truth = true_value(e, p.name);
        if (!truth || p.name == "recording") continue;
        double found = p.value;
        if (p.unit == "rad" && (p.name == "phase_rad" || p.name == "direction_rad"))
          found = *truth + wrapped(found - *truth);
        j.parameters.push_back({e.active.effect + " " + p.name, *truth, found, p.stderr_value});
      }
    }
}

// When a wheel was on a bump, in one of the given runs.
std::vector<double> times_on_bump(const Run& run, const DrawnEffect& bump, double wheelbase_m) {
  std::vector<double> times;
  const Vec2 place{bump.active.parameter("x_m"), bump.active.parameter("y_m")};
  const double side_m = bump.active.component == "left_wheel" ? 0.5 * wheelbase_m : -0.5 * wheelbase_m;
  for (std::size_t i = 0; i < run.driven.true_axle.size(); i += 20)
    if (length(run.driven.true_axle[i].pose * Vec2{0.0, side_m} - place) < bump.active.parameter("radius_m") + 0.02)
      times.push_back(run.driven.true_axle[i].time_s);
  return times;
}

// An event that came half a second later differs by what it does until then, whose size is known by what it does later.
double first_half_second_sigma(const DrawnCase& c, std::size_t effect) {
  const double from_s = c.effects[effect].active.parameter("at_s");
  std::vector<InnovationRun> runs;
  for (const Run& run : c.given) {
    runs.push_back(run.known);
    InnovationRun& known = runs.back();
    std::vector<BodyMotion>& motion = known.extra[effect].per_step;
    for (std::size_t i = 0; i < motion.size(); ++i)
      if (known.wheels[i].time_s < from_s || known.wheels[i].time_s >= from_s + 0.5) motion[i] = {};
  }
  return significance(runs, c.truth())[effect];
}

void judge_place(Judged& j, const DrawnCase& c, const Diagnosis& d) {
  if (!j.named_first || d.findings.empty()) return;
  const Finding& f = d.findings.front();
  for (std::size_t k = 0; k < c.effects.size(); ++k) {
    const DrawnEffect& e = c.effects[k];
    if (label(f.effect, f.component) != label(e.active)) continue;
    const Vec2 place{e.active.parameter("x_m"), e.active.parameter("y_m")};
    if (e.active.effect == "slip_zone")
      j.place_error_m = f.where.zone ? length(Vec2{f.where.zone->x_m, f.where.zone->y_m} - place) : 1e3;
    const bool event = e.only_in_run >= 0, bump = e.active.effect == "bump";
    if (!event && !bump) continue;
    j.time_error_s = 1e3;
    if (event) j.first_half_second_sigma = first_half_second_sigma(c, k);
    if (bump) j.place_error_m = 1e3;
    for (std::size_t r = 0; r < c.given.size(); ++r) {
      if (c.given[r].driven.recording.name != f.where.recording || f.where.time_s.empty()) continue;
      const double at_s = 0.5 * (f.where.time_s.front().first + f.where.time_s.front().second);
      if (event && static_cast<int>(r) == e.only_in_run) j.time_error_s = std::abs(at_s - e.active.parameter("at_s"));
      if (!bump) continue;
      for (double t : times_on_bump(c.given[r], e, c.robot.scenario.actual.wheelbase_m))
        j.time_error_s = std::min(*j.time_error_s, std::abs(at_s - t));
      const Track& way = c.given[r].driven.true_axle;
      const double side_m = (e.active.component == "left_wheel" ? 0.5 : -0.5) * c.robot.scenario.actual.wheelbase_m;
      if (const std::optional<Pose> there = pose_at(way, std::clamp(at_s, way.front().time_s, way.back().time_s)))
        j.place_error_m = length(*there * Vec2{0.0, side_m} - place);
    }
    if (bump && f.where.zone) j.place_error_m = length(Vec2{f.where.zone->x_m, f.where.zone->y_m} - place);
  }
}

}  // namespace

bool JudgedParameter::held() const { return std::abs(found - truth) <= 1.96 * stderr_value; }

Judged judged(const DrawnCase& c, const Progress& progress) {
  Judged j;
  j.number = c.number;
  j.kind = c.kind;
  j.level = c.level;
  j.poor = c.poor;
  j.significance = c.significance;
  j.thrown_away = c.thrown_away;
  j.counts_per_turn = c.robot.nominal().counts_per_wheel_turn();
  for (const DrawnEffect& e : c.effects) j.truth.push_back(label(e.active));
  std::vector<Recording> given, held_out;
  for (const Run& run : c.given) given.push_back(run.driven.recording);
  for (const Run& run : c.held_out) held_out.push_back(run.driven.recording);
  const auto begin = std::chrono::steady_clock::now();
  const Result<Diagnosis> d = diagnose(given, held_out, c.robot.scenario.vehicle, {}, progress);
  j.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!d) {
    j.failed = d.error().message();
    return j;
  }
  j.verdict = d->verdict;
  for (const DrawnEffect& e : c.effects)
    for (const AskedEffect& asked : d->asked)
      if (asked.effect == e.active.effect) j.asked_p.push_back(asked.p_value);
  judge_names(j, *d);
  judge_parameters(j, c, *d);
  judge_place(j, c, *d);

  std::vector<InnovationRun> known;
  for (const Run& run : c.given) known.push_back(run.known);
  const OracleFit oracle = oracle_fit(known, c.truth());
  for (std::size_t k = 0; k < oracle.size.size(); ++k)
    j.oracle_sigma.push_back((oracle.size[k] - 1.0) * oracle.significance[k]);
  const FittedModel calibrated = calibrated_model_of(*d), with_findings = model_of(*d);
  const double arm_m = 0.5 * c.robot.scenario.actual.wheelbase_m;
  SquaredError before, after, best;
  for (const Run& run : c.held_out) {
    const Track truth = true_tracked(run);
    const std::string& name = run.driven.recording.name;
    if (const Result<Track> t = predicted_track(run.driven.recording, calibrated.vehicle_in(name)))
      before.add(*t, truth, arm_m);
    if (const Result<Track> t =
            predicted_track(run.driven.recording, with_findings.vehicle_in(name), with_findings.effects_in(name)))
      after.add(*t, truth, arm_m);
    best.add(oracle_track(run.known, oracle.model, oracle.size), truth, arm_m);
  }
  j.calibrated_m2 = before.mean();
  j.with_findings_m2 = after.mean();
  j.oracle_m2 = best.mean();
  j.concealed = concealment(c, calibrated);
  return j;
}

std::string Judged::line() const {
  static const char* const kKinds[] = {"nothing", "one", "two", "outside"};
  static const char* const kVerdicts[] = {"found", "nothing_missing", "unknown_effect", "ambiguous", "cannot_say"};
  const auto joined = [](const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& one : list) text += (text.empty() ? "" : "+") + one;
    return text.empty() ? std::string("-") : text;
  };
  std::string text = std::to_string(number) + " " + kKinds[static_cast<int>(kind)] + " ";
  text += kind == Kind::nothing ? "" : std::string(name_of(level)) + " ";
  text +=
      (poor ? "squares " : "") + joined(truth) + " -> " + kVerdicts[static_cast<int>(verdict)] + " " + joined(found);
  if (verdict == Verdict::unknown_effect) text += " (" + regime + ")";
  if (!listed.empty()) text += " or " + joined(listed);
  text += number_text(" | mm %.2f", 1e3 * std::sqrt(calibrated_m2)) +
          number_text(" %.2f", 1e3 * std::sqrt(with_findings_m2)) +
          number_text(" oracle %.2f", 1e3 * std::sqrt(oracle_m2)) + " |";
  text += std::string(concealed.absorbed ? "a" : "") + (concealed.under_noise ? "n" : "") +
          (concealed.seldom ? "s" : "") + (concealed.cancels ? "c" : "");
  for (const JudgedParameter& p : parameters)
    text += " " + p.name + number_text(" %.4g", p.truth) + number_text("/%.4g", p.found) +
            number_text("+-%.2g", p.stderr_value);
  if (place_error_m) text += number_text(" place %.2f m", *place_error_m);
  if (time_error_s) text += number_text(" time %.2f s", *time_error_s);
  if (first_half_second_sigma) text += number_text(" (first half second %.1f sigma)", *first_half_second_sigma);
  for (std::size_t k = 0; k < oracle_sigma.size(); ++k)
    text += number_text(" of %.1f sigma,", significance[k]) + number_text(" oracle off by %+.1f", oracle_sigma[k]);
  for (double p : asked_p) text += number_text(" p %.2g", p);
  text += number_text(" %.0f counts", counts_per_turn);
  if (!failed.empty()) text += " FAILED " + failed;
  return text + number_text(" (%.1f s", seconds) + ", " + std::to_string(thrown_away) + " thrown)";
}

}  // namespace odolab::concealed
