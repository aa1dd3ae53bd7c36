#include "core/diagnosis/units/together/told_together.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/diagnosis/advice/advice.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/unit_models.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

constexpr double kShortestStep_s = 0.045;  // between samples of the truth: more say nothing about what lasts
constexpr double kCoarse_m = 0.004, kCoarseRate_hz = 25.0;

// Of one sample, or of what its frame wanders meanwhile.
double size_of_truths_error_m(const JoinedNoise& noise) {
  constexpr double kMeanwhile_s = 10.0;
  const double lasts_s = noise.wander_lasts_s > 0.0 ? 0.5 * noise.wander_lasts_s : kMeanwhile_s;
  return std::max(noise.truth_position_m, noise.wander_m_per_sqrt_s * std::sqrt(lasts_s));
}

// Each unit by itself has the way of a second and more to tell joints and wheels by, with a handful of samples.
bool comes_seldom(const JoinedRun& run) {
  constexpr double kSeldom_hz = 3.0;
  const Track& t = run.tracked;
  return t.size() < 2 || static_cast<double>(t.size() - 1) < kSeldom_hz * (t.back().time_s - t.front().time_s);
}

// What each unit is not asked any more, since all together know it better.
bool is_told_together(const Finding& f) {
  static const std::set<std::string> others = {"clock_rate",      "wheel_toe",        "unknown",
                                               "link_angle_bias", "link_length_bias", "pivot_angle_bias"};
  return !is_of_the_truth(f.effect) && !is_data_fault(f.effect) && others.count(f.effect) == 0;
}

// A name in the unit's own words.
Finding of_unit(const JoinedName& name, const VehicleUnit& unit, const std::vector<VehicleUnit>& all) {
  Finding f = name.finding;
  f.component = component_in_unit(unit.name, f.component, all).value_or(f.component);
  f.alternatives.clear();
  return f;
}

enum class Names { all, findings };

std::vector<Finding> names_on(const ToldTogether& told, std::size_t unit, Names which) {
  const std::vector<VehicleUnit> units = units_of(told.model.vehicle());
  std::vector<Finding> all;
  for (const JoinedName& name : told.said.names) {
    if (which == Names::findings && name.is_usual) continue;
    if (std::find(name.units.begin(), name.units.end(), unit) != name.units.end())
      all.push_back(of_unit(name, units[unit], units));
  }
  return all;
}

std::string usual_in_words(const std::vector<JoinedName>& names) {
  std::string said;
  for (const JoinedName& name : names) {
    if (!name.is_usual) continue;
    const FoundParameter& p = name.finding.parameters.front();
    said += (said.empty() ? "" : ", ") + effect_words(name.finding.effect) + " of " +
            component_words(name.finding.component) + formatted(" (%.2g +- %.1g", p.value, p.stderr_value) +
            (p.unit == "1" ? "" : " " + p.unit) + ")";
  }
  return said.empty() ? said
                      : "the units tell of each other what any vehicle does, and no more of it than any: " + said +
                            "; it is reckoned with, and no finding";
}

}  // namespace

std::optional<ToldTogether> told_together(std::vector<JoinedRun> runs, const Vehicle& nominal,
                                          std::vector<double> clock_s, std::vector<std::string> names,
                                          double family_wise_error, const Progress& progress) {
  for (JoinedRun& run : runs) run.tracked = at_least_apart(run.tracked, kShortestStep_s);
  ToldTogether told{JoinedModel(std::move(runs), nominal, std::move(clock_s), std::move(names)), {}};
  told.model.fit_all();
  const std::vector<JoinedRun>& given = told.model.given();
  if (told.model.follows_truth() && told.model.has_headings() &&
      size_of_truths_error_m(told.model.noise()) < kCoarse_m && std::none_of(given.begin(), given.end(), comes_seldom))
    return std::nullopt;
  told.said = joined_names(told.model, family_wise_error, progress);
  return told;
}

bool may_be_coarse(const std::vector<JoinedRun>& runs) {
  // Third differences of what comes often hold no motion, but noise: of white noise they have 20 times its variance.
  for (const JoinedRun& run : runs) {
    const Track& t = run.tracked;
    if (t.size() < 5 || static_cast<double>(t.size() - 1) < kCoarseRate_hz * (t.back().time_s - t.front().time_s))
      return true;
    std::vector<double> sizes;
    for (std::size_t i = 3; i < t.size(); ++i) {
      const Vec2 third = t[i].pose.position() - 3.0 * t[i - 1].pose.position() + 3.0 * t[i - 2].pose.position() -
                         t[i - 3].pose.position();
      sizes.push_back(std::hypot(third.x_m, third.y_m));
    }
    // the median length of two normal numbers is 1.18 times their size
    if (median(std::move(sizes)) / (1.177 * std::sqrt(20.0)) > kCoarse_m) return true;
  }
  return false;
}

std::vector<Understood> understood_without(const ToldTogether& told, const std::vector<Recording>& recordings,
                                           const std::vector<JoinedRun>& runs, const std::vector<double>& clock_s,
                                           const Vehicle& nominal) {
  const std::vector<VehicleUnit> units = units_of(told.model.vehicle());
  std::vector<Understood> all;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    all.push_back({&recordings[r], unit_samples(recordings[r], nominal)});
    if (told.said.names.empty()) continue;
    JoinedFilter where(runs[r], told.model.vehicle(), clock_s[r]);
    where.run(told.model.noise());
    const std::vector<Track> tracks = where.smoothed();
    std::vector<std::vector<BodyMotion>> motions(units.size());
    for (std::size_t u = 0; u < units.size(); ++u) {
      FittedModel model;
      for (const Finding& f : names_on(told, u, Names::all))
        model.effects.push_back({f.as_active(), {}, f.where.recording});
      motions[u] = motions_of(drive_view(0, run_of_wheels(all.back().samples, u), units[u].drive, false, tracks[u]),
                              model.effects_in(recordings[r].name));
    }
    all.back().samples = without_effects(all.back().samples, units, motions).samples;
  }
  return all;
}

bool acts_on(const ToldTogether& told, std::size_t unit) { return !names_on(told, unit, Names::all).empty(); }

Diagnosis with_names(const ToldTogether& told, std::size_t unit, const Diagnosis& as_read, Diagnosis again) {
  std::vector<Finding>& findings = again.findings;
  const bool has_the_truth = units_of(told.model.vehicle())[unit].carries_truth;
  std::erase_if(findings, [&](const Finding& f) {
    return is_told_together(f) || is_of_a_joint(f) || is_data_fault(f.effect) ||
           (is_of_floor_or_truth(f) && !has_the_truth);
  });
  for (const Finding& f : as_read.findings)
    if (is_data_fault(f.effect)) findings.push_back(f);
  for (const Finding& f : names_on(told, unit, Names::findings)) findings.push_back(f);
  for (FitTable Diagnosis::*table : {&Diagnosis::train, &Diagnosis::held_out}) {
    (again.*table).nominal = (as_read.*table).nominal;
    (again.*table).calibrated = (as_read.*table).calibrated;
  }
  again.calibration_alone = as_read.calibration_alone;
  again.residuals_before = as_read.residuals_before;
  again.responses = as_read.responses;
  if (std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.effect == "unknown"; }))
    return again;
  if (!findings.empty())
    again.verdict = Verdict::found;
  else if (again.verdict != Verdict::cannot_say)
    again.verdict = Verdict::nothing_missing;
  return again;
}

void put_names_into(const ToldTogether& told, Diagnosis& d) {
  put_asked_into(told.said.asked, d);
  d.unseen_gain.reset();  // each unit's own, which has not what all know
  const JoinedNoise& noise = told.model.noise();
  for (LeastSquaresCalibration* c : {&d.calibration, &d.calibration_alone}) {
    c->noise.wheel_m_per_sqrt_m = noise.wheel_m_per_sqrt_m;
    c->noise.truth_position_m = told.model.has_truth() ? noise.truth_position_m : 0.0;
    c->noise.truth_heading_rad = told.model.has_headings() ? noise.truth_heading_rad : 0.0;
  }
  std::erase_if(d.findings, [](const Finding& f) { return is_told_together(f); });
  if (told.said.unknown) {
    std::erase_if(d.findings, [](const Finding& f) { return f.effect == "unknown"; });
    d.findings.insert(d.findings.begin(), *told.said.unknown);
    return;
  }
  for (const JoinedName& name : told.said.names)
    if (!name.is_usual) d.findings.push_back(name.finding);
  put_in_order(d.findings);
  if (std::string usual = usual_in_words(told.said.names); !usual.empty()) d.warnings.push_back(std::move(usual));
  d.cannot_judge = d.cannot_judge && are_most_effects(d.not_testable);
}

}  // namespace odolab
