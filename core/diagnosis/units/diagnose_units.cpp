#include "core/diagnosis/units/diagnose_units.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/calibration/evened_recording.h"
#include "core/diagnosis/frozen_truth.h"
#include "core/diagnosis/units/biases_from_inside.h"
#include "core/diagnosis/units/by_positions.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/heading_of_way.h"
#include "core/diagnosis/units/inside.h"
#include "core/diagnosis/units/joined_clocks.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/joint_residuals.h"
#include "core/diagnosis/units/mended_counts.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_asked.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/diagnosis/units/together/told_together.h"
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
    if (f == d.findings.end() || runs.size() < 2 || e.is_from_inside) continue;
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

// How the truth's heading is mounted on a vehicle that tows, and whose wheels are not looked at: known by the way it
// goes, and the hitch's encoder no better than that.
GeometryFit geometry_of_trailer(const std::vector<JoinedRun>& runs, const Vehicle& nominal) {
  constexpr double kUnknown_rad = 0.05, kLeast_rad = 0.001;
  std::vector<Track> tracked;
  for (const JoinedRun& run : runs) tracked.push_back(run.tracked);
  const std::optional<HeadingOfWay> way = heading_of_way(tracked);
  JointEstimate heading;
  heading.parameter = {"truth_mounting.heading_rad",
                       "rad",
                       kUnknown_rad,
                       [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.heading_rad; },
                       "truth_mounting_offset",
                       "truth",
                       kLeast_rad,
                       "heading_rad"};
  heading.nominal = heading.value = nominal.truth.axle_T_tracked.heading_rad;
  Vehicle turned = nominal;
  if (way && std::abs(way->mounting_rad - heading.nominal) > std::max(kLeast_rad, kSigmasOfBias * way->stderr_rad)) {
    heading.value = turned.truth.axle_T_tracked.heading_rad = way->mounting_rad;
    heading.stderr_value = way->stderr_rad;
    heading.determined = true;
  }
  GeometryFit geometry = fitted_geometry(runs, turned);
  for (JointEstimate& e : geometry.joints)
    if (e.parameter.name == "hitch_angle_offset_rad")
      e.stderr_value = std::hypot(e.stderr_value, way ? way->stderr_rad : kUnknown_rad);
  geometry.joints.push_back(heading);
  return geometry;
}

// Of a truth that no unit's own recording has as it was: by the first unit's wheels, whether it repeats itself.
std::vector<Finding> frozen_truths(const std::vector<Recording>& recordings, const std::vector<JoinedRun>& runs,
                                   const DifferentialDrive& first) {
  std::vector<Finding> frozen;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    DataFault fault{"truth_frozen", "truth", recordings[r].name,
                    frozen_truth(truth_samples(recordings[r]), wheels_of(runs[r].samples, 0), first), ""};
    if (fault.time_s.empty()) continue;
    fault.sentence = in_words_of_frozen(fault.time_s.size());
    frozen.push_back(finding_of(fault));
  }
  return frozen;
}

using Read = std::vector<std::vector<UnitSample>>;  // of each recording

Read samples_of(std::vector<Understood> all) {
  Read read;
  for (Understood& u : all) read.push_back(std::move(u.samples));
  return read;
}

// Where the truth sits, and its clocks, as the unit that carries it knows them: better than stretches of half a metre
// do.
void put_truth_as_on(const Diagnosis& carrying, const Vehicle& nominal, GeometryFit& geometry) {
  const LeastSquaresCalibration& known = carrying.calibration;
  geometry.vehicle.truth.axle_T_tracked = known.vehicle.truth.axle_T_tracked;
  for (std::size_t r = 0; r < std::min(geometry.clock_s.size(), known.time_offset_s.size()); ++r)
    geometry.clock_s[r] = known.time_offset_s[r] - nominal.truth.time_offset_s;
}

JoinedRun joined_run(const Recording& r, const Vehicle& nominal) {
  MendedCounts mended = with_mended_counts(unit_samples(r, nominal), nominal);
  JoinedRun run{std::move(mended.samples), tracked_poses(r), true, std::move(mended.guessed)};
  if (!comes_often(run.tracked))
    run.tracked = few_poses(std::move(run.tracked), run.samples, nominal.truth.time_offset_s);
  return run;
}

// Stamps of arrival put back onto their even period, of all encoders alike.
std::vector<Recording> all_evened(const std::vector<Recording>& given, const Vehicle& nominal,
                                  std::vector<std::string>& said) {
  std::vector<Recording> all = given;
  const std::vector<std::string> encoders = encoder_columns(nominal);
  for (Recording& r : all) {
    if (encoders.empty()) break;
    std::optional<EvenedRecording> even = evened(r, encoders);
    if (!even) continue;
    said.insert(said.end(), even->said.begin(), even->said.end());
    r = std::move(even->recording);
  }
  return all;
}

Result<Diagnosis> diagnose_even(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  std::vector<JoinedRun> runs, runs_held_out;
  for (const Recording& r : train) runs.push_back(joined_run(r, nominal));
  for (const Recording& r : held_out) runs_held_out.push_back(joined_run(r, nominal));
  const std::vector<VehicleUnit> units = units_of(nominal);
  const bool no_truth =
      std::any_of(runs.begin(), runs.end(), [](const JoinedRun& run) { return !comes_often(run.tracked); });
  const bool has_positions = have_positions(train) && have_positions(held_out);
  const bool is_alone = units.size() == 1 && !units[0].carries_truth;
  if (no_truth && (units.size() > 1 || (is_alone && has_positions)))
    return diagnose_inside(train, held_out, nominal, options, progress);
  if (no_truth && is_alone && !(have_ends(train) && have_ends(held_out)))
    return Error{train.front().name, "no truth",
                 "one, of both ends of each run at least: the towing vehicle's own wheels are no measure of its way"};

  const bool is_towed = std::holds_alternative<EncoderTrailer>(nominal.kind);
  GeometryFit geometry = no_truth   ? geometry_of_file(nominal, runs.size())
                         : is_towed ? geometry_of_trailer(runs, nominal)
                                    : fitted_geometry(runs, nominal);
  std::vector<ClockRate> clocks;
  if (!carries_truth(units) && !no_truth) clocks = put_clocks_right(runs, nominal, geometry);
  if (is_towed && !clocks.empty()) geometry = geometry_of_trailer(runs, nominal);
  if (!clocks.empty() && !runs_held_out.empty()) {
    GeometryFit of_held_out = geometry;
    put_clocks_right(runs_held_out, nominal, of_held_out);
  }
  set_most_pivots_right(geometry);
  std::vector<double> clock_held_out_s;
  for (const JoinedRun& run : runs_held_out)
    clock_held_out_s.push_back(no_truth ? 0.0 : fitted_geometry({run}, geometry.vehicle).clock_s.front());
  if (!goes_on(progress, 0.1)) return Error{"diagnosis", "stopped before its end", ""};

  std::optional<ToldTogether> told;
  if (units.size() > 1 && units.size() <= kMostJoinedUnits && may_be_coarse(runs)) {
    std::vector<std::string> names;
    for (const Recording& r : train) names.push_back(r.name);
    told = told_together(runs, nominal, geometry.clock_s, names, options.family_wise_error,
                         [&](double share) { return goes_on(progress, 0.1 * share); });
  }
  if (told) {
    take_biases(told->model, geometry, true);
    set_most_pivots_right(geometry);
  }

  std::vector<Diagnosis> diagnoses;
  std::optional<ErringJoint> erring;
  DiagnosisOptions of_one = options;
  of_one.family_wise_error /= static_cast<double>(units.size());
  std::vector<std::vector<UnitSample>> samples, as_read, held_out_as_read;
  std::vector<std::string> names;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    samples.push_back(runs[r].samples), names.push_back(train[r].name);
    as_read.push_back(unit_samples(train[r], nominal));
  }
  for (std::size_t r = 0; r < runs_held_out.size(); ++r) {
    samples.push_back(runs_held_out[r].samples), names.push_back(held_out[r].name);
    held_out_as_read.push_back(unit_samples(held_out[r], nominal));
  }
  const auto judged = [&](std::size_t u, const Read& read, const Read& read_held_out,
                          const Progress& part) -> Result<Diagnosis> {
    std::vector<Recording> own, own_held_out;
    for (std::size_t r = 0; r < runs.size(); ++r)
      own.push_back(recording_of_unit(train[r], read[r], runs[r].tracked, geometry.vehicle, u, geometry.clock_s[r],
                                      !units[u].carries_truth));
    for (std::size_t r = 0; r < runs_held_out.size(); ++r)
      own_held_out.push_back(recording_of_unit(held_out[r], read_held_out[r], runs_held_out[r].tracked,
                                               geometry.vehicle, u, clock_held_out_s[r], !units[u].carries_truth));
    of_one.truth_errors = joint_errors(samples, names, geometry.vehicle, u);
    Result<Diagnosis> one = diagnose(own, own_held_out, vehicle_of_unit(units[u], nominal), of_one, part);
    if (!one) return Error{units[u].name + ": " + one.error().where, one.error().found, one.error().expected};
    leave_out_standing(*one, own, units[u].drive);
    if (!units[u].carries_truth) leave_out_traces(*one, std::holds_alternative<MultiCastor>(nominal.kind));
    return one;
  };
  for (std::size_t u = 0; u < units.size(); ++u) {
    Result<Diagnosis> one = judged(u, as_read, held_out_as_read, [&](double share) {
      return goes_on(progress, 0.1 + 0.8 * (static_cast<double>(u) + share) / static_cast<double>(units.size()));
    });
    if (!one) return one.error();
    if (!units[u].carries_truth && !told && !no_truth) {
      const auto& calibrated = std::get<DifferentialDrive>(one->calibration_alone.vehicle.kind);
      std::optional<ErringJoint> of_unit =
          erring_joint(runs, geometry.clock_s, with_drive(geometry.vehicle, u, calibrated), u);
      if (of_unit && (!erring || of_unit->gain > erring->gain)) erring = std::move(of_unit);
    }
    diagnoses.push_back(std::move(*one));
    if (units[u].carries_truth) put_truth_as_on(diagnoses.back(), nominal, geometry);
  }
  if (told) {
    const Read without = samples_of(understood_without(*told, train, runs, geometry.clock_s, nominal)),
               held_out_without =
                   samples_of(understood_without(*told, held_out, runs_held_out, clock_held_out_s, nominal));
    for (std::size_t u = 0; u < units.size(); ++u) {
      if (!acts_on(*told, u)) {
        diagnoses[u] = with_names(*told, u, diagnoses[u], diagnoses[u]);
        continue;
      }
      Result<Diagnosis> again = judged(u, without, held_out_without, [&](double) { return goes_on(progress, 0.9); });
      if (!again) return again.error();
      diagnoses[u] = with_names(*told, u, diagnoses[u], std::move(*again));
    }
  }
  if (!goes_on(progress, 0.9)) return Error{"diagnosis", "stopped before its end", ""};
  const bool are_trucks = units.size() > 1 && !std::holds_alternative<MultiCastor>(nominal.kind);
  if (!told && are_trucks)
    put_inside_beside_truth(geometry, train, nominal, diagnoses, [&](double) { return goes_on(progress, 0.95); });
  if (!goes_on(progress, 0.95)) return Error{"diagnosis", "stopped before its end", ""};
  Diagnosis d = merged(diagnoses, geometry, nominal, train);
  Vehicle as_mounted = nominal;
  if (is_towed) as_mounted.truth.axle_T_tracked.heading_rad = geometry.vehicle.truth.axle_T_tracked.heading_rad;
  prove_biases(d, runs, geometry, as_mounted);
  if (told) put_names_into(*told, d);
  if (erring && std::none_of(d.findings.begin(), d.findings.end(), is_of_a_joint)) {
    add_erring_joint(*erring, nominal, d);
    leave_out_biases_beside_erring_joints(d.findings);
  }
  if (!clocks.empty()) {
    std::erase_if(d.findings, [](const Finding& f) { return f.effect == "clock_rate"; });
    d.findings.push_back(finding_of(clocks));
    if (d.verdict == Verdict::nothing_missing || d.verdict == Verdict::cannot_say) d.verdict = Verdict::found;
  }
  if (!carries_truth(units)) {
    const std::vector<Finding> frozen = frozen_truths(train, runs, units[0].drive);
    d.findings.insert(d.findings.end(), frozen.begin(), frozen.end());
    if (!frozen.empty() && d.verdict == Verdict::nothing_missing) d.verdict = Verdict::found;
  }
  mark_named(d);
  return d;
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
  std::vector<std::string> said;
  const std::vector<Recording> even = all_evened(train, nominal, said),
                               even_held_out = all_evened(held_out, nominal, said);
  Result<Diagnosis> d = diagnose_even(even, even_held_out, nominal, options, progress);
  if (d) d->warnings.insert(d->warnings.end(), said.begin(), said.end());
  return d;
}

}  // namespace odolab
