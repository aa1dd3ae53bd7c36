#include "core/diagnosis/units/diagnose_units.h"

#include <algorithm>

#include "core/diagnosis/select.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/merged.h"
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

// Readings that hold and then catch up are a fault only where the axle went on meanwhile: castors and trucks that stand
// may set off within a sample.
bool stood_still(const std::pair<double, double>& time_s, bool left, const Recording& recording,
                 const DifferentialDrive& drive) {
  const std::vector<WheelSample> wheels = wheel_samples(recording, drive);
  const Track truth = truth_track(recording);
  const auto rad = [&](const WheelSample& w) { return left ? w.left_rad : w.right_rad; };
  std::size_t first = 0;
  while (first < wheels.size() && wheels[first].time_s < time_s.first - 1e-9) ++first;
  std::size_t last = first;
  while (last + 1 < wheels.size() && rad(wheels[last + 1]) == rad(wheels[first])) ++last;
  if (last <= first || last + 1 >= wheels.size()) return false;
  const std::optional<Pose> from = pose_at(truth, wheels[first].time_s), to = pose_at(truth, wheels[last].time_s);
  if (!from || !to) return false;
  const Pose moved = between(*from, *to);
  const double radius_m = left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
  const double rolled_m = moved.x_m + (left ? -0.5 : 0.5) * drive.wheelbase_m * wrapped(moved.heading_rad);
  return std::abs(rolled_m) < 0.5 * radius_m * std::abs(rad(wheels[last + 1]) - rad(wheels[last]));
}

void leave_out_standing(Diagnosis& d, const std::vector<Recording>& recordings, const DifferentialDrive& drive) {
  for (Finding& f : d.findings) {
    if (f.effect != "encoder_data_fault") continue;
    for (const Recording& r : recordings)
      if (r.name == f.where.recording)
        f.where.time_s.erase(
            std::remove_if(f.where.time_s.begin(), f.where.time_s.end(),
                           [&](const auto& t) { return stood_still(t, f.component == "left_wheel", r, drive); }),
            f.where.time_s.end());
  }
  d.findings.erase(
      std::remove_if(d.findings.begin(), d.findings.end(),
                     [](const Finding& f) { return f.effect == "encoder_data_fault" && f.where.time_s.empty(); }),
      d.findings.end());
}

// What is left without a name on a unit whose place the joints tell, and which predicts nothing: the rounding of the
// joints is no white noise, and castors on one frame drag each other along. The same of a small name where castors do.
void leave_out_traces(Diagnosis& d, bool castor) {
  constexpr double kLeastGain = 30.0;
  if (!d.held_out.calibrated || d.findings.empty()) return;
  const auto predicts = [&](const std::optional<FitFigures>& with) {
    const FitFigures& without = *d.held_out.calibrated;
    if (!with || !(without.position_rms_m > 0.0) || !(without.heading_rms_rad > 0.0)) return true;
    const double position = with->position_rms_m / without.position_rms_m,
                 heading = with->heading_rms_rad / without.heading_rms_rad;
    return 0.5 * (position * position + heading * heading) < kMaterial;
  };
  const bool names_predict = predicts(d.held_out.with_findings), rest_predicts = predicts(d.held_out.spline);
  const std::size_t before = d.findings.size();
  d.findings.erase(std::remove_if(d.findings.begin(), d.findings.end(),
                                  [&](const Finding& f) {
                                    if (f.effect == "unknown") return !rest_predicts;
                                    return castor && !names_predict && f.log_likelihood_gain > 0.0 &&
                                           f.log_likelihood_gain < kLeastGain;
                                  }),
                   d.findings.end());
  if (d.findings.size() == before) return;
  d.warnings.push_back(
      "something is left that is as small as the rounding of the joints or the slip of wheels on one "
      "frame, and that predicts no run it was not fitted on");
  const bool open =
      std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return !f.alternatives.empty(); });
  d.verdict = d.findings.empty() ? Verdict::nothing_missing : open ? Verdict::ambiguous : Verdict::found;
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
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (runs[r].tracked.size() < 2 && units.size() > 1)
      return Error{train[r].name, "a truth without headings, or none", "truth_x_m, truth_y_m and truth_heading_rad"};

  const GeometryFit geometry = fitted_geometry(runs, nominal);
  std::vector<double> clock_held_out_s;
  for (const JoinedRun& run : runs_held_out)
    clock_held_out_s.push_back(fitted_geometry({run}, geometry.vehicle).clock_s.front());
  if (!goes_on(progress, 0.1)) return Error{"diagnosis", "stopped before its end", ""};

  std::vector<Diagnosis> diagnoses;
  DiagnosisOptions of_one = options;
  of_one.family_wise_error /= static_cast<double>(units.size());
  for (std::size_t u = 0; u < units.size(); ++u) {
    std::vector<Recording> own, own_held_out;
    for (std::size_t r = 0; r < runs.size(); ++r)
      own.push_back(
          recording_of_unit(train[r], runs[r].samples, runs[r].tracked, geometry.vehicle, u, geometry.clock_s[r]));
    for (std::size_t r = 0; r < runs_held_out.size(); ++r)
      own_held_out.push_back(recording_of_unit(held_out[r], runs_held_out[r].samples, runs_held_out[r].tracked,
                                               geometry.vehicle, u, clock_held_out_s[r]));
    const double from = 0.1 + 0.9 * static_cast<double>(u) / static_cast<double>(units.size());
    const Progress part = [&](double share) {
      return goes_on(progress, from + 0.9 * share / static_cast<double>(units.size()));
    };
    Result<Diagnosis> one = diagnose(own, own_held_out, vehicle_of_unit(units[u], nominal), of_one, part);
    if (!one) return Error{units[u].name + ": " + one.error().where, one.error().found, one.error().expected};
    leave_out_standing(*one, own, units[u].drive);
    if (!units[u].carries_truth) leave_out_traces(*one, std::holds_alternative<MultiCastor>(nominal.kind));
    diagnoses.push_back(std::move(*one));
  }
  return merged(diagnoses, geometry, nominal, train, options.family_wise_error);
}

}  // namespace odolab
