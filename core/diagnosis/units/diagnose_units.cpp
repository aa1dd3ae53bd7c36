#include "core/diagnosis/units/diagnose_units.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/inside.h"
#include "core/diagnosis/units/joined_clocks.h"
#include "core/diagnosis/units/joint_residuals.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_asked.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

namespace {

std::optional<Error> unusable(const Recording& r, const Vehicle& nominal) {
  const std::string where = r.name.empty() ? "recording" : r.name;
  if (const std::vector<std::string> problems = problems_in(r); !problems.empty())
    return Error{where, "", problems.front()};
  if (const std::string missing = missing_columns(r, nominal); !missing.empty())
    return Error{where, "no " + missing, "the encoders of a " + kind_name(nominal)};
  if (unit_samples(r, nominal).size() < 2) return Error{where, "no two rows in which all encoders can be told", ""};
  return std::nullopt;
}

// A biased encoder must be so in runs that it was not fitted on.
void prove_biases(Diagnosis& d, const std::vector<JoinedRun>& runs, const GeometryFit& geometry,
                  const Vehicle& nominal) {
  bool dropped = false;
  for (const JointEstimate& e : geometry.joints) {
    const auto f = std::find_if(d.findings.begin(), d.findings.end(), [&](const Finding& g) {
      return !e.parameter.effect.empty() && e.parameter.component != "truth" && g.effect == e.parameter.effect &&
             g.component == e.parameter.component;
    });
    if (f == d.findings.end() || runs.size() < 2) continue;
    const double ratio = left_out_ratio(runs, nominal, e.parameter.name);
    if (ratio < 1.0) {
      char text[120];
      std::snprintf(text, sizeof text, "; what the parts contradict in runs left out falls to %.0f %%", 100.0 * ratio);
      f->sentence += text;
    } else {
      d.findings.erase(f);
      dropped = true;
    }
  }
  if (dropped && d.findings.empty()) d.verdict = Verdict::nothing_missing;
}

bool has_findings_of_vehicle(const Diagnosis& d) {
  return std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.component != "truth"; });
}

// Whether a bias that is worth a name may lie hidden in what the truth does not tell.
bool hides_a_bias(const GeometryFit& geometry) {
  return std::any_of(geometry.joints.begin(), geometry.joints.end(), [](const JointEstimate& e) {
    return !e.parameter.effect.empty() && e.parameter.component != "truth" && e.determined &&
           kSigmasOfBias * e.stderr_value > e.parameter.least;
  });
}

// Trucks know better how they stand to each other than a coarse truth knows where they are. False where they say
// nothing of a joint, or what the truth contradicts.
bool take_biases_from_inside(GeometryFit& geometry, const Diagnosis& inside) {
  constexpr double kBetterKnown = 0.5, kContradicted = 3.0;  // times the error by the truth
  bool taken = false;
  for (JointEstimate& e : geometry.joints)
    for (const Finding& f : inside.findings) {
      if (e.parameter.effect.empty() || f.effect != e.parameter.effect || f.component != e.parameter.component)
        continue;
      const FoundParameter& bias = f.parameters.front();
      const double off = bias.value - (e.value - e.nominal);
      if (!e.determined || bias.stderr_value > kBetterKnown * e.stderr_value ||
          std::abs(off) > kContradicted * e.stderr_value)
        continue;
      e.value = e.nominal + bias.value;
      e.stderr_value = bias.stderr_value;
      e.parameter.of(geometry.vehicle) = e.value;
      taken = true;
    }
  return taken;
}

// Too little outside truth to say where each unit was.
bool is_poor(const JoinedRun& run) {
  constexpr double kLongest_s = 1.0;  // between two samples, in the mean
  const std::size_t n = run.tracked.size();
  return n < 2 || run.tracked.back().time_s - run.tracked.front().time_s > kLongest_s * static_cast<double>(n - 1);
}

JoinedRun joined_run(const Recording& r, const Vehicle& nominal) {
  return {unit_samples(r, nominal), tracked_poses(r)};
}

}  // namespace

Result<Diagnosis> diagnose_units(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                 const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  if (const std::vector<std::string> problems = problems_in(nominal.kind); !problems.empty())
    return Error{nominal.name, "", problems.front()};
  if (train.empty()) return Error{"recordings", "none", "one or more"};
  for (const std::vector<Recording>* set : {&train, &held_out})
    for (const Recording& r : *set)
      if (const std::optional<Error> problem = unusable(r, nominal)) return *problem;

  std::vector<JoinedRun> runs, runs_held_out;
  for (const Recording& r : train) runs.push_back(joined_run(r, nominal));
  for (const Recording& r : held_out) runs_held_out.push_back(joined_run(r, nominal));
  const std::vector<VehicleUnit> units = units_of(nominal);
  const bool no_truth = std::any_of(runs.begin(), runs.end(), [](const JoinedRun& run) { return is_poor(run); });
  if (no_truth && units.size() > 1) return diagnose_inside(train, held_out, nominal, options, progress);
  if (no_truth && !units[0].carries_truth)
    return Error{train.front().name, "no truth with headings, a sample a second or more",
                 "one: the towing vehicle's own wheels are no measure of its way"};

  GeometryFit geometry = fitted_geometry(runs, nominal);
  std::vector<ClockRate> clocks;
  if (!carries_truth(units)) clocks = put_clocks_right(runs, nominal, geometry);
  if (!clocks.empty() && !runs_held_out.empty()) {
    GeometryFit of_held_out = geometry;
    put_clocks_right(runs_held_out, nominal, of_held_out);
  }
  set_most_pivots_right(geometry);
  std::vector<double> clock_held_out_s;
  for (const JoinedRun& run : runs_held_out)
    clock_held_out_s.push_back(fitted_geometry({run}, geometry.vehicle).clock_s.front());
  if (!goes_on(progress, 0.1)) return Error{"diagnosis", "stopped before its end", ""};

  std::vector<Diagnosis> diagnoses;
  std::optional<ErringJoint> erring;
  DiagnosisOptions of_one = options;
  of_one.family_wise_error /= static_cast<double>(units.size());
  for (std::size_t u = 0; u < units.size(); ++u) {
    std::vector<Recording> own, own_held_out;
    for (std::size_t r = 0; r < runs.size(); ++r)
      own.push_back(recording_of_unit(train[r], runs[r].samples, runs[r].tracked, geometry.vehicle, u,
                                      geometry.clock_s[r], !units[u].carries_truth));
    for (std::size_t r = 0; r < runs_held_out.size(); ++r)
      own_held_out.push_back(recording_of_unit(held_out[r], runs_held_out[r].samples, runs_held_out[r].tracked,
                                               geometry.vehicle, u, clock_held_out_s[r], !units[u].carries_truth));
    const Progress part = [&](double share) {
      return goes_on(progress, 0.1 + 0.8 * (static_cast<double>(u) + share) / static_cast<double>(units.size()));
    };
    Result<Diagnosis> one = diagnose(own, own_held_out, vehicle_of_unit(units[u], nominal), of_one, part);
    if (!one) return Error{units[u].name + ": " + one.error().where, one.error().found, one.error().expected};
    leave_out_standing(*one, own, units[u].drive);
    if (!units[u].carries_truth) leave_out_traces(*one, std::holds_alternative<MultiCastor>(nominal.kind));
    if (!units[u].carries_truth) {
      const auto& calibrated = std::get<DifferentialDrive>(one->calibration_alone.vehicle.kind);
      std::optional<ErringJoint> of_unit =
          erring_joint(runs, geometry.clock_s, with_drive(geometry.vehicle, u, calibrated), u);
      if (of_unit && (!erring || of_unit->gain > erring->gain)) erring = std::move(of_unit);
    }
    diagnoses.push_back(std::move(*one));
  }
  Diagnosis d = merged(diagnoses, geometry, nominal, train);
  prove_biases(d, runs, geometry, nominal);
  const bool are_trucks = units.size() > 1 && !std::holds_alternative<MultiCastor>(nominal.kind);
  if (are_trucks && !has_findings_of_vehicle(d) && hides_a_bias(geometry)) {
    const Progress nearly_done = [&](double) { return goes_on(progress, 0.95); };
    const Result<Diagnosis> inside = diagnose_inside(train, held_out, nominal, options, nearly_done);
    if (!inside && !goes_on(progress, 0.95)) return inside.error();
    if (inside && take_biases_from_inside(geometry, *inside)) d = merged(diagnoses, geometry, nominal, train);
  }
  if (erring) add_erring_joint(*erring, nominal, d);
  if (!clocks.empty()) {
    std::erase_if(d.findings, [](const Finding& f) { return f.effect == "clock_rate"; });
    d.findings.push_back(finding_of(clocks));
    if (d.verdict == Verdict::nothing_missing || d.verdict == Verdict::cannot_say) d.verdict = Verdict::found;
  }
  mark_named(d);
  return d;
}

}  // namespace odolab
