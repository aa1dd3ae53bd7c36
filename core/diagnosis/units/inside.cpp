#include "core/diagnosis/units/inside.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/geometry_from_inside.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_asked.h"
#include "core/diagnosis/units/together/told_together.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_models.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

namespace {

constexpr int kMostRounds = 3;  // units to blame, one after the other

double gain_of(const Diagnosis& d) {
  double gain = 0.0;
  for (const Finding& f : d.findings) gain += f.effect == "unknown" ? 0.0 : f.log_likelihood_gain;
  return gain;
}

// What a unit can be blamed for: the rest is of the joints, of the truth that is none, or has no name.
void keep_names_of_wheels(Diagnosis& d, const VehicleUnit& unit, const JointRounding& rounding) {
  d.findings.erase(std::remove_if(d.findings.begin(), d.findings.end(),
                                  [&](const Finding& f) {
                                    return lasts(f) || may_be_rounding(f, unit, rounding) ||
                                           f.effect.rfind("truth_", 0) == 0 || f.effect == "clock_rate" ||
                                           f.effect == "floor_slope_creep" ||
                                           (f.effect == "wheel_toe" && !f.alternatives.empty() &&
                                            f.alternatives.front().effect == "truth_mounting_offset");
                                  }),
                   d.findings.end());
  if (d.findings.empty() && d.verdict != Verdict::cannot_say) d.verdict = Verdict::nothing_missing;
}

const std::vector<std::string>& common_effects() {
  static const std::vector<std::string> names = {
      "clock_rate",   "floor_slope_creep",     "truth_time_offset",      "truth_smoothing",
      "truth_frozen", "truth_mounting_offset", "speed_dependent_radius", "turn_speed_loss"};
  return names;
}

struct Sets {
  std::vector<Understood> train, held_out;
};

// What each unit looks like beside the others.
struct Judged {
  GeometryFit geometry;
  std::vector<Diagnosis> units;  // as they were where they were not asked again
};

class Judge {
 public:
  Judge(const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress)
      : nominal_(nominal), units_(units_of(nominal)), options_(options), progress_(progress) {
    options_.family_wise_error /= static_cast<double>(units_.size());
  }

  // Asks every unit that is not set aside.
  Result<Judged> ask(const Sets& sets, std::vector<Diagnosis> before, const std::vector<char>& set_aside) const {
    Result<GeometryFit> fit = geometry_from_inside(sets.train, nominal_, progress_);
    if (!fit) return fit.error();
    Judged judged{std::move(*fit), std::move(before)};
    judged.units.resize(units_.size());
    Known known{judged.geometry.vehicle, judged.geometry.drives};
    for (std::size_t u = 0; u < units_.size(); ++u) known.vehicle = with_drive(known.vehicle, u, known.drives[u]);
    for (std::size_t u = 0; u < units_.size(); ++u) {
      if (set_aside[u]) continue;
      const Result<std::vector<Recording>> train = recordings_of(known, sets.train, u);
      const Result<std::vector<Recording>> held_out = recordings_of(known, sets.held_out, u);
      if (!train || !held_out) return train ? held_out.error() : train.error();
      Result<Diagnosis> one = judged_alone(*train, *held_out, u);
      if (!one) return Error{units_[u].name + ": " + one.error().where, one.error().found, one.error().expected};
      judged.units[u] = std::move(*one);
    }
    return judged;
  }

  Sets without(Sets sets, std::size_t unit, const Diagnosis& blamed_for) const {
    const FittedModel model = model_of(blamed_for);
    take_off(sets.train, unit, model, units_);
    take_off(sets.held_out, unit, model, units_);
    return sets;
  }

 private:
  static Result<std::vector<Recording>> recordings_of(const Known& known, const std::vector<Understood>& set,
                                                      std::size_t unit) {
    std::vector<Recording> own;
    for (const Understood& r : set) {
      const Result<Track> track = way_by_others(known, r.samples, unit);
      if (!track) return track.error();
      own.push_back(recording_of_unit(*r.recording, r.samples, *track, known.vehicle, unit, 0.0, true));
    }
    return own;
  }

  Result<Diagnosis> judged_alone(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                 std::size_t u) const {
    Vehicle own = vehicle_of_unit(units_[u], without_mounting(nominal_));
    own.kind = units_[u].drive;
    const JointRounding rounding = rounding_from_inside(nominal_);
    DiagnosisOptions options = options_;
    options.truth_step_m = rounding.position_m;
    options.truth_step_rad = rounding.heading_rad;
    Result<Diagnosis> one = diagnose(train, held_out, own, options, progress_);
    if (!one) return one;
    leave_out_standing(*one, train, units_[u].drive);
    leave_out_traces(*one, std::holds_alternative<MultiCastor>(nominal_.kind));
    keep_names_of_wheels(*one, units_[u], rounding);
    return one;
  }

  Vehicle nominal_;
  std::vector<VehicleUnit> units_;
  DiagnosisOptions options_;
  Progress progress_;
};

// Against a unit that errs all others contradict, and hardly in a way that is one of their own: the one whose effects
// explain most is to blame. Where others come near, the one without whose effects the rest is most in order.
struct Blame {
  std::size_t unit = 0;
  bool either = false;  // what is left does not tell which of two
};

Result<std::optional<Blame>> unit_to_blame(const Judge& judge, const Sets& sets, const Judged& judged,
                                           const std::vector<char>& set_aside) {
  std::vector<std::size_t> suspects;
  for (std::size_t u = 0; u < judged.units.size(); ++u)
    if (!set_aside[u] && gain_of(judged.units[u]) > 0.0) suspects.push_back(u);
  if (suspects.empty()) return std::optional<Blame>();
  std::sort(suspects.begin(), suspects.end(),
            [&](std::size_t a, std::size_t b) { return gain_of(judged.units[a]) > gain_of(judged.units[b]); });
  constexpr double kNear = 0.5;  // of the largest gain; of two units either may look worse
  const double most = gain_of(judged.units[suspects[0]]);
  if (judged.units.size() > 2)
    while (gain_of(judged.units[suspects.back()]) < kNear * most) suspects.pop_back();
  if (suspects.size() < 2) return std::optional<Blame>(Blame{suspects[0]});
  std::vector<double> left;
  for (std::size_t suspect : suspects) {
    std::vector<char> aside = set_aside;
    aside[suspect] = 1;
    const Result<Judged> then = judge.ask(judge.without(sets, suspect, judged.units[suspect]), judged.units, aside);
    if (!then) return then.error();
    left.push_back(0.0);
    for (std::size_t u = 0; u < judged.units.size(); ++u)
      if (!aside[u]) left.back() += gain_of(then->units[u]);
  }
  const std::size_t best = static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  const bool either = left.size() == 2 && std::abs(left[0] - left[1]) < kClearlyBeaten;
  return std::optional<Blame>(Blame{suspects[best], either});
}

struct Blamed {
  Sets sets;                         // what the blamed units did wrong taken off
  Judged judged;                     // what each is blamed for, and what the rest looks like then
  std::vector<char> is;              // of each unit
  std::vector<Alternative> instead;  // of the first unit to blame
};

// Blames one unit after the other, until none errs.
Result<Blamed> blamed_one_by_one(const Judge& judge, Sets sets, const std::vector<VehicleUnit>& units) {
  std::vector<char> blamed(units.size(), 0);
  std::vector<Alternative> instead;
  Result<Judged> judged = judge.ask(sets, {}, blamed);
  for (int round = 0; round < kMostRounds && judged; ++round) {
    const Result<std::optional<Blame>> blame = unit_to_blame(judge, sets, *judged, blamed);
    if (!blame) return blame.error();
    if (!*blame) break;
    const std::size_t unit = (*blame)->unit;
    for (std::size_t u = 0; (*blame)->either && round == 0 && u < units.size(); ++u)
      for (const Finding& f : judged->units[u].findings)
        if (u != unit)
          instead.push_back(
              {f.effect, component_of_unit(units[u].name, f.component), f.log_likelihood_gain, "an outside truth"});
    blamed[unit] = 1;
    sets = judge.without(std::move(sets), unit, judged->units[unit]);
    judged = judge.ask(sets, judged->units, blamed);
  }
  if (!judged) return judged.error();
  return Blamed{std::move(sets), std::move(*judged), std::move(blamed), std::move(instead)};
}

}  // namespace

Result<Diagnosis> diagnose_inside(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  const std::vector<VehicleUnit> units = units_of(nominal);
  if (const auto* platform = std::get_if<MultiCastor>(&nominal.kind); platform && platform->castors.size() < 3)
    return Error{nominal.name, "no outside truth with headings, a sample a second or more, and two castors",
                 "such a truth, or three castors and more, of which the others judge one"};
  Sets sets;
  // What lasts all of them tell together; then what happened once is asked of each against the others.
  const auto runs_of = [&](const std::vector<Recording>& set) {
    std::vector<JoinedRun> runs;
    for (const Recording& r : set) runs.push_back({without_held_counts(unit_samples(r, nominal), nominal), {}});
    return runs;
  };
  std::vector<std::string> names;
  for (const Recording& r : train) names.push_back(r.name);
  const std::vector<JoinedRun> runs = runs_of(train), runs_held_out = runs_of(held_out);
  const ToldTogether told = *told_together(runs, without_mounting(nominal), {}, names, options.family_wise_error,
                                           [&](double share) { return goes_on(progress, 0.3 * share); });
  if (!goes_on(progress, 0.3)) return Error{"diagnosis", "stopped before its end", ""};
  sets.train = understood_without(told, train, runs, std::vector<double>(runs.size()), nominal);
  sets.held_out = understood_without(told, held_out, runs_held_out, std::vector<double>(runs_held_out.size()), nominal);
  const Judge judge(nominal, options, [&](double) { return goes_on(progress, 0.5); });

  Result<Blamed> blamed = blamed_one_by_one(judge, std::move(sets), units);
  if (!blamed) return blamed.error();
  const std::vector<Alternative>& instead = blamed->instead;
  std::vector<Diagnosis>& of_units = blamed->judged.units;
  for (std::size_t u = 0; u < units.size(); ++u) of_units[u] = with_names(told, u, of_units[u], of_units[u]);

  Diagnosis d = merged(of_units, blamed->judged.geometry, nominal, train, false);
  put_names_into(told, d);
  for (LeastSquaresCalibration* c : {&d.calibration, &d.calibration_alone}) c->scale_is_open = true;
  if (!instead.empty() && !d.findings.empty()) {
    d.findings.front().alternatives.insert(d.findings.front().alternatives.end(), instead.begin(), instead.end());
    d.verdict = Verdict::ambiguous;
  }
  const auto is_common = [](const auto& of) {
    return std::find(common_effects().begin(), common_effects().end(), of.effect) != common_effects().end();
  };
  std::erase_if(d.not_testable, is_common);
  std::erase_if(d.asked, is_common);
  mark_named(d);
  for (const std::string& name : common_effects())
    d.not_testable.push_back({name, "without an outside truth what all units do alike does not show between them",
                              "the same with an outside truth that has headings"});
  d.warnings.insert(d.warnings.begin(),
                    "no outside truth with headings, a sample a second or more: the units were judged against each "
                    "other; their scale, and what they all do alike, is not seen");
  return d;
}

}  // namespace odolab
