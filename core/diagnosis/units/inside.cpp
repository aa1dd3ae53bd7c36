#include "core/diagnosis/units/inside.h"

#include <algorithm>
#include <functional>

#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/mended_counts.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_asked.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/together/told_together.h"
#include "core/diagnosis/units/told_geometry.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_models.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

namespace {

// What all units do alike, and what only a truth shows that is followed; poses at both ends tell where it sits.
std::vector<std::string> common_effects(OutsideTruth truth) {
  std::vector<std::string> names = {"clock_rate",   "floor_slope_creep",      "truth_time_offset", "truth_smoothing",
                                    "truth_frozen", "speed_dependent_radius", "turn_speed_loss"};
  if (truth == OutsideTruth::nothing) names.push_back("truth_mounting_offset");
  return names;
}

// Each unit beside the others, whose way stands for its truth.
struct Judged {
  GeometryFit geometry;
  std::vector<Diagnosis> units;
};

// `begun`: where the vehicle's reference point is in the room at the start of each recording, if that is known. What
// the others say is mended, the unit's own counts are not: their faults are to be found.
Result<std::vector<Recording>> recordings_of(const Known& known, const std::vector<Understood>& set,
                                             const std::vector<Understood>& mended, const std::vector<Pose>& begun,
                                             std::size_t unit) {
  std::vector<Recording> own;
  for (std::size_t k = 0; k < set.size(); ++k) {
    Result<Track> track = way_by_others(known, mended[k].samples, unit);
    if (!track) return track.error();
    if (!begun.empty()) {
      const Pose room_T_way = begun[k] * inverse(track->front().pose);
      for (TimedPose& t : *track) t.pose = room_T_way * t.pose;
      unwrap_headings(*track);
    }
    own.push_back(recording_of_unit(*set[k].recording, set[k].samples, *track, known.vehicle, unit, 0.0, true));
  }
  return own;
}

Result<std::vector<Recording>> as_recorded(const std::vector<Understood>& set, const Vehicle& nominal,
                                           std::size_t unit) {
  std::vector<Recording> own;
  for (const Understood& r : set)
    own.push_back(recording_of_unit(*r.recording, r.samples, {}, nominal, unit, 0.0, false));
  return own;
}

// Each unit's recordings, with what stands for its truth.
using OwnRecordings = std::function<Result<std::vector<Recording>>(const Known&, bool held_out, std::size_t unit)>;

Result<Judged> judged_by(const OwnRecordings& recordings, GeometryFit geometry, bool by_positions,
                         const Vehicle& nominal, DiagnosisOptions options, const Progress& progress) {
  const std::vector<VehicleUnit> units = units_of(nominal);
  Judged judged{std::move(geometry), {}};
  Known known{without_mounting(judged.geometry.vehicle), judged.geometry.drives};
  for (std::size_t u = 0; u < units.size(); ++u) known.vehicle = with_drive(known.vehicle, u, known.drives[u]);
  const JointRounding rounding = rounding_from_inside(nominal);
  options.family_wise_error /= static_cast<double>(units.size());
  for (std::size_t u = 0; u < units.size(); ++u) {
    const bool by_truth = by_positions && units[u].carries_truth, by_others = units.size() > 1 && !by_truth;
    options.truth_step_m = by_others ? rounding.position_m : 0.0;
    options.truth_step_rad = by_others ? rounding.heading_rad : 0.0;
    const Result<std::vector<Recording>> own = recordings(known, false, u), own_held_out = recordings(known, true, u);
    if (!own || !own_held_out) return own ? own_held_out.error() : own.error();
    Vehicle vehicle = vehicle_of_unit(units[u], by_truth ? nominal : without_mounting(nominal));
    vehicle.truth.is_reckoned = by_others;
    Result<Diagnosis> one = diagnose(*own, *own_held_out, vehicle, options, [&](double share) {
      return goes_on(progress, (static_cast<double>(u) + share) / static_cast<double>(units.size()));
    });
    if (!one) return Error{units[u].name + ": " + one.error().where, one.error().found, one.error().expected};
    leave_out_standing(*one, *own, units[u].drive);
    // What is no fault of its readings all of them tell together.
    std::erase_if(one->findings, [&](const Finding& f) {
      return !is_data_fault(f.effect) && !(by_truth && (is_of_the_truth(f.effect) || is_of_floor_or_truth(f))) &&
             (by_others || f.effect != "clock_rate");
    });
    if (one->findings.empty() && one->verdict != Verdict::cannot_say) one->verdict = Verdict::nothing_missing;
    judged.units.push_back(std::move(*one));
  }
  return judged;
}

std::vector<JoinedRun> runs_of(const std::vector<Recording>& set, OutsideTruth truth, const Vehicle& nominal) {
  std::vector<JoinedRun> runs;
  for (const Recording& r : set) {
    MendedCounts mended = with_mended_counts(unit_samples(r, nominal), nominal);
    JoinedRun run{std::move(mended.samples), {}, truth == OutsideTruth::ends, std::move(mended.guessed)};
    if (truth == OutsideTruth::positions) run.tracked = tracked_positions(r);
    if (truth == OutsideTruth::ends)
      run.tracked = few_poses(tracked_poses(r), run.samples, nominal.truth.time_offset_s);
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

Result<Diagnosis> diagnose_inside(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal, OutsideTruth truth, const DiagnosisOptions& options,
                                  const Progress& progress) {
  const std::vector<VehicleUnit> units = units_of(nominal);
  if (const auto* platform = std::get_if<MultiCastor>(&nominal.kind); platform && platform->castors.size() < 3)
    return Error{nominal.name, "no outside truth with headings, a sample a second or more, and two castors",
                 "such a truth, or three castors and more, of which the others judge one"};
  if (units.size() > kMostJoinedUnits)
    return Error{nominal.name,
                 std::to_string(units.size()) + " units and no outside truth with headings, a sample a second or more",
                 "such a truth, or " + std::to_string(kMostJoinedUnits) + " units at most"};
  std::vector<std::string> names;
  for (const Recording& r : train) names.push_back(r.name);
  std::vector<JoinedRun> runs = runs_of(train, truth, nominal);
  const auto leave_truth_out = [&] { runs = runs_of(train, truth = OutsideTruth::nothing, nominal); };
  const auto told_by_all = [&] {
    return *told_together(runs, truth == OutsideTruth::nothing ? without_mounting(nominal) : nominal, {}, names,
                          options.family_wise_error, [&](double share) { return goes_on(progress, 0.3 * share); });
  };
  // Ends where the vehicle comes back to where it set off do not tell how large it is.
  constexpr double kMayTell = 0.005, kTellTheScale = 0.01;  // before it is fitted, and once it is
  if (truth == OutsideTruth::ends && JoinedModel(runs, nominal, {}, names).expected_stderr_of_scale() > kMayTell)
    leave_truth_out();
  ToldTogether told = told_by_all();
  if (truth == OutsideTruth::ends && told.model.stderr_of_scale() > kTellTheScale) {
    leave_truth_out();
    told = told_by_all();
  }
  if (!goes_on(progress, 0.3)) return Error{"diagnosis", "stopped before its end", ""};
  const bool by_positions = truth == OutsideTruth::positions, is_measured = truth != OutsideTruth::nothing;
  const std::vector<JoinedRun> runs_held_out = runs_of(held_out, truth, nominal);
  std::vector<double> clock_s(runs.size()), clock_held_out_s(runs_held_out.size());
  std::vector<Pose> begun, begun_held_out;
  if (is_measured) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      clock_s[r] = told.model.clock_s(r);
      begun.push_back(start_of(told.model, r));
    }
    for (std::size_t r = 0; r < runs_held_out.size(); ++r) {
      JoinedModel one({runs_held_out[r]}, told.model.vehicle(), {}, {held_out[r].name});
      if (by_positions) one.fit(2);
      clock_held_out_s[r] = one.clock_s(0);
      begun_held_out.push_back(start_of(one, 0));
    }
  }
  const std::vector<Understood> train_without = understood_without(told, train, runs, clock_s, nominal);
  const std::vector<Understood> train_mended = with_mended_counts(train_without, nominal);
  GeometryFit geometry = told_geometry(told.model, nominal);
  const std::vector<Understood> held_out_without =
      understood_without(told, held_out, runs_held_out, clock_held_out_s, nominal);
  const std::vector<Understood> held_out_mended = with_mended_counts(held_out_without, nominal);
  const auto recordings = [&](const Known& known, bool are_held_out, std::size_t u) -> Result<std::vector<Recording>> {
    const std::vector<Understood>& set = are_held_out ? held_out_without : train_without;
    if (by_positions && units[u].carries_truth) return as_recorded(set, nominal, u);
    if (units.size() > 1)
      return are_held_out ? recordings_of(known, set, held_out_mended, begun_held_out, u)
                          : recordings_of(known, set, train_mended, begun, u);
    std::vector<Recording> own;
    for (std::size_t r = 0; r < set.size(); ++r)
      own.push_back(recording_by_positions(*set[r].recording, set[r].samples, (are_held_out ? runs_held_out : runs)[r],
                                           (are_held_out ? clock_held_out_s : clock_s)[r], told.model));
    return own;
  };
  Result<Judged> judged = judged_by(recordings, std::move(geometry), by_positions, nominal, options,
                                    [&](double share) { return goes_on(progress, 0.3 + 0.6 * share); });
  if (!judged) return judged.error();
  for (std::size_t u = 0; u < units.size(); ++u) {
    Diagnosis& one = judged->units[u];
    if (is_measured && !(by_positions && units[u].carries_truth)) widen_by_scale(told.model.stderr_of_scale(), one);
    if (acts_on(told, u)) std::erase_if(one.findings, [](const Finding& f) { return is_data_fault(f.effect); });
    one = with_names(told, u, one, one);  // counts from which something was taken off are no whole ones
  }
  Diagnosis d = merged(judged->units, judged->geometry, nominal, train, truth);
  put_names_into(told, d);
  if (by_positions) {
    d.warnings.insert(d.warnings.begin(),
                      units.size() == 1 ? "the truth has no headings: the trailer's wheels and its hitch tell them"
                                        : "the truth has no headings: where the units are and how large, all of them "
                                          "and the truth tell together; by itself each was judged by the others' way");
    mark_named(d);
    return d;
  }
  for (LeastSquaresCalibration* c : {&d.calibration, &d.calibration_alone}) c->scale_is_open = !is_measured;
  const std::vector<std::string> common = common_effects(truth);
  const auto is_common = [&](const auto& of) {
    return std::find(common.begin(), common.end(), of.effect) != common.end();
  };
  std::erase_if(d.not_testable, is_common);
  std::erase_if(d.asked, is_common);
  mark_named(d);
  for (const std::string& name : common)
    d.not_testable.push_back({name, "without an outside truth what all units do alike does not show between them",
                              "the same with an outside truth that has headings"});
  d.warnings.insert(d.warnings.begin(),
                    std::string("no outside truth with headings, a sample a second or more: the units were judged "
                                "against each other; ") +
                        (is_measured ? "how large they all are the poses at the ends tell, and what they all do alike "
                                       "is not seen"
                                     : "their scale, and what they all do alike, is not seen"));
  return d;
}

}  // namespace odolab
