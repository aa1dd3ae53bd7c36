#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/two_digits.h"
#include "core/calibration/column_names.h"
#include "core/calibration/turned_mounting.h"
#include "core/diagnosis/advice/advice.h"
#include "core/diagnosis/asked_effects.h"
#include "core/diagnosis/by_names.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/findings_of.h"
#include "core/diagnosis/gathered_over.h"
#include "core/diagnosis/generic/adequacy.h"
#include "core/diagnosis/generic/responses.h"
#include "core/diagnosis/judged_adequacy.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/mismatch.h"
#include "core/diagnosis/model/coarse_counts.h"
#include "core/diagnosis/model/driven_again.h"
#include "core/diagnosis/named.h"
#include "core/diagnosis/parted.h"
#include "core/diagnosis/place_response.h"
#include "core/diagnosis/quality/obeying_wheels.h"
#include "core/diagnosis/ready_recordings.h"
#include "core/diagnosis/units/diagnose_units.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/diagnosis/warnings.h"
#include "core/diagnosis/where.h"

namespace odolab {

namespace {

constexpr double kOfTheUnnamed = 0.25;  // of the family-wise error of names, that something without one may have

std::string undone_in_words(const Undone& u, const std::string& recording) {
  return recording + formatted(": from %.2f to %.2f s the truth is elsewhere", u.from_s, u.to_s) + " by " +
         two_digits(1e3 * u.away_m) + " mm and " + two_digits(std::abs(u.turned_rad) * 180.0 / kPi) +
         " degrees, and then back, as where a tracker loses a marker or the vehicle gives way; left out";
}

// Names sought beside a calibration, and what of the recordings was left out on the way.
struct SoughtNames {
  JointModel calibrated;
  Named names;
  std::vector<std::string> of_undone;
};

// Unset where `progress` stops it. A truth that is somewhere else for a while shows nothing of the vehicle; what does
// so time and again is no mishap.
std::optional<SoughtNames> sought_beside(JointModel calibrated, const ReadyRecordings& ready,
                                         const Predictor& predictor, const Vehicle& nominal,
                                         const DiagnosisOptions& options, const Progress& progress) {
  constexpr int kMostUndone = 3;
  const double wheelbase_m = std::get<DifferentialDrive>(nominal.kind).wheelbase_m;
  calibrated.truth_errors = options.truth_errors;
  calibrated.driven_again = std::make_shared<const DrivenAgain>(calibrated, counts_may_feign(calibrated));
  calibrated.truth_feigns_m = options.truth_step_m + 0.5 * wheelbase_m * options.truth_step_rad;
  std::vector<std::string> of_undone;
  for (int left_out = 0;; ++left_out) {
    std::optional<Named> names =
        named(calibrated, predictor, options.family_wise_error, progress, left_out < kMostUndone);
    if (!names) return std::nullopt;
    if (!names->selected.undone) return SoughtNames{std::move(calibrated), std::move(*names), std::move(of_undone)};
    const Undone& u = *names->selected.undone;
    of_undone.push_back(undone_in_words(u, ready.train[static_cast<std::size_t>(u.run)].recording.name));
    calibrated.leave_out(u.run, u.from_s, u.to_s);
    calibrated.fit(2);
    calibrated.fit_noise_and_all();
  }
}

// Names that are not told apart, for the drive that would. Beaten in the form that fits best, a name would come back in
// another.
std::vector<Confusion> confusions(const JointModel& joint, const Selected& selected) {
  std::vector<Confusion> confused;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k)
    for (const ScoredCandidate& c : selected.alternatives[k]) {
      const std::size_t forms = std::max<std::size_t>(1, c.effect->forms.size());
      for (std::size_t form = 0; form < forms; ++form) {
        std::vector<double> shape = c.test.shape;
        if (forms > 1) shape.back() = static_cast<double>(form);
        confused.push_back({static_cast<int>(k), c.effect, shape, c.test.value, selected.evidence[k].test.inflation});
      }
    }
  return confused;
}

// What shows, or what something without a name resembles, could show.
bool is_said(const std::string& effect, const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
    return f.effect == effect || std::any_of(f.alternatives.begin(), f.alternatives.end(),
                                             [&](const Alternative& a) { return a.effect == effect; });
  });
}

// Whether something that has no name was found on a patch of floor, and this on another.
bool is_elsewhere(const Finding& f, const std::vector<Finding>& findings) {
  return f.where.zone && std::any_of(findings.begin(), findings.end(), [&](const Finding& g) {
           return g.effect == "unknown" && g.where.zone && !overlap(*f.where.zone, *g.where.zone);
         });
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

// What is wrong with the recordings themselves stands beside all physics; of those held out it gives no finding.
void add_faults(Diagnosis& d, const ReadyRecordings& ready) {
  for (const CheckedRecording& c : ready.train)
    for (const DataFault& fault : c.faults)
      if (fault.effect == kEncoderGap)
        d.warnings.push_back(in_words(fault));
      else
        d.findings.push_back(finding_of(fault));
  for (const CheckedRecording& c : ready.held_out)
    for (const DataFault& fault : c.faults) d.warnings.push_back(in_words(fault));
  for (const MovedMounting& m : ready.moved) d.findings.push_back(finding_of(m));
}

// `found`: of physics, the mounting and the clocks; the findings of `d` are these and faults.
Verdict verdict_of(const Diagnosis& d, const std::vector<Finding>& found, bool has_unnamed) {
  if (has_unnamed) return Verdict::unknown_effect;
  if (found.empty() && d.cannot_judge) return Verdict::cannot_say;
  if (d.findings.empty()) return Verdict::nothing_missing;
  const bool ambiguous =
      std::any_of(found.begin(), found.end(), [](const Finding& f) { return !f.alternatives.empty(); });
  return ambiguous ? Verdict::ambiguous : Verdict::found;
}

// Which effects could not have shown, and what to drive next.
void advise(Diagnosis& d, const Named& names, double family_wise_error) {
  const std::vector<Confusion> confused =
      d.verdict == Verdict::ambiguous ? confusions(names.joint, names.selected) : std::vector<Confusion>{};
  const std::vector<Visible> looks = visible(names.joint, family_wise_error);
  const Advice next = advice(names.joint, confused, unseen(looks));
  d.asked = asked_effects(names.joint, names.selected, looks);
  for (AskedEffect& a : d.asked)  // names that do not suffice were let in, and are none
    a.named = a.named &&
              std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) { return f.effect == a.effect; });
  d.not_testable = next.not_testable;
  std::erase_if(d.not_testable, [&](const NotTestable& n) { return is_said(n.effect, d.findings); });
  d.cannot_judge = d.cannot_judge || are_most_effects(d.not_testable);
  if (d.verdict == Verdict::nothing_missing && d.cannot_judge) d.verdict = Verdict::cannot_say;
  for (const Finding& f : d.findings)
    if (!f.alternatives.empty() && d.next_drive.empty()) d.next_drive = f.alternatives.front().told_apart_by;
  if (!confused.empty() || d.next_drive.empty()) {
    d.next_drive = next.next_drive;
    d.next_legs = next.next_legs;
  }
  if (names.joint.scalars_on_the_way() == 0) {
    d.next_drive = "anything: in these recordings the wheels hardly turn while the truth looks on";
    d.next_legs.clear();
  }
}

// Calibration alone is the model, to the last digit.
void stand_by_calibration(Diagnosis& d) {
  d.calibration = d.calibration_alone;
  d.fitted_vehicle = d.calibration_alone.vehicle;
  const std::vector<double>& clocks = d.calibration_alone.time_offset_s;
  for (std::size_t r = 0; r < std::min(clocks.size(), d.truth_clock_s.size()); ++r)
    d.truth_clock_s[r].second = clocks[r];
}

// Innovations before and after, under one noise, and what shows about the first finding's place.
void draw(Diagnosis& d, const JointModel& calibrated, const JointModel& said) {
  const FittedNoise between = noise_of_pictures(calibrated.model.noise, said.model.noise);
  d.residuals_before = residuals_of(calibrated.under(between));
  d.residuals_after = residuals_of(said.under(between));
  if (d.findings.empty() || !d.findings.front().where.zone) return;
  const Finding& first = d.findings.front();
  const char* const what = first.effect == "bump"        ? "bump"
                           : first.effect == "slip_zone" ? "patch"
                                                         : "place where it happened";
  Response about = zone_response(*first.where.zone, what, d.residuals_before, d.residuals_after);
  if (!about.at.empty()) d.responses.insert(d.responses.begin(), std::move(about));
}

JudgedPart judged_of(const InnovationRun& run) {
  const InnovationRun& all = run.as_recorded ? *run.as_recorded : run;
  JudgedPart judged{run.name, {}, run.left_out};
  for (std::size_t i = 0; i < all.truth.size(); ++i)
    if (all.set_aside.empty() || !all.set_aside[i]) judged.truth_s.push_back(all.truth[i].time_s);
  return judged;
}

// Of the recordings that `d` was fitted to, and of those it was not.
void name_recordings(Diagnosis& d, const std::vector<Recording>& train, const std::vector<Recording>& held_out) {
  for (const Recording& r : train) d.fitted_on.push_back(r.name);
  for (const Recording& r : held_out) d.held_out_runs.push_back(r.name);
}

void say_over_which_way(Diagnosis& d, const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                        const Vehicle& nominal) {
  const Vehicle& vehicle = d.fitted_vehicle ? *d.fitted_vehicle : nominal;
  d.train_over = gathered_over(train, vehicle);
  d.held_out_over = d.left_out_in_turn ? d.train_over : gathered_over(held_out, vehicle);
}

// As read, or as they obey commands where these are all there is.
std::vector<Recording> with_wheels(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  const DifferentialDrive& drive = std::get<DifferentialDrive>(nominal.kind);
  std::vector<Recording> all;
  for (const Recording& r : recordings)
    all.push_back(has_commands_alone(r, wheel_samples(r, drive)) ? with_obeying_wheels(r, drive) : r);
  return all;
}

// Recordings made ready and calibrated, and the names that were sought beside.
struct Looked {
  ReadyRecordings ready;
  Predictor predictor;
  SoughtNames sought;

  bool names_explain_all() const {
    const JointModel& joint = sought.names.joint;
    return std::any_of(joint.accepted.begin(), joint.accepted.end(),
                       [](const AcceptedEffect& a) { return a.acts_on_motion(); }) &&
           joint.distrust() == 0.0;
  }
};

Result<Looked> looked_at(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                         const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress,
                         bool truth_is_white, const std::vector<TimeStretches>& parted, double right_older_s) {
  const Error stopped{"diagnosis", "stopped before its end", ""};
  Result<ReadyRecordings> ready = ready_recordings(
      train, held_out, nominal, [&](double share) { return goes_on(progress, 0.25 * share); }, truth_is_white, parted,
      right_older_s);
  if (!ready) return ready.error();
  Result<JointModel> calibrated_only = calibrated_model(*ready, nominal);
  if (!calibrated_only) return calibrated_only.error();
  if (!goes_on(progress, 0.3)) return stopped;

  Predictor predictor(ready->held_out, ready->by_right_clocks(), nominal,
                      ready->clocks_put_right ? ready->clocks_put_right->held_out_clocks : std::vector<AlignedClock>{});
  std::optional<SoughtNames> sought = sought_beside(*calibrated_only, *ready, predictor, nominal, options, progress);
  if (!sought) return stopped;
  // What seemed a truth that comes back has names now: they are sought as if it never did.
  if (sought->calibrated.model.noise.wander_lasts_s > 0.0 && sought->names.joint.model.noise.wander_lasts_s == 0.0) {
    calibrated_only = calibrated_model(*ready, nominal, false);
    if (!calibrated_only) return calibrated_only.error();
    sought = sought_beside(*calibrated_only, *ready, predictor, nominal, options, progress);
    if (!sought) return stopped;
  }
  return Looked{*std::move(ready), std::move(predictor), *std::move(sought)};
}

// The same, of all samples of the truth where these are white beside the names. A strong effect correlates innovations
// as a tracker does that smooths: if it has a name by few of the truth's samples, and with names all are white, it was
// that.
Result<Looked> looked_at_as_is(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                               const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress,
                               const std::vector<TimeStretches>& parted, double right_older_s = 0.0) {
  Result<Looked> looked = looked_at(train, held_out, nominal, options, progress, false, parted, right_older_s);
  if (!looked || !looked->ready.told().truth_lasts() || !looked->names_explain_all()) return looked;
  Result<Looked> by_all = looked_at(train, held_out, nominal, options, progress, true, parted, right_older_s);
  if (by_all && by_all->names_explain_all()) looked = std::move(by_all);
  if (!goes_on(progress, 0.75)) return Error{"diagnosis", "stopped before its end", ""};
  return looked;
}

// Whether beside what went on for a while something is found at a place or a moment, or without a name: then that was
// where it did most, and no incident.
bool is_met_again(const Finding& f) {
  if (f.effect == "unknown") return !f.is_parted;
  const Effect* const e = catalogue_entry(f.as_active());
  return e && (e->local || e->of_one_recording || e->and_later_recordings);
}

// `shows_beside_held_out`: whether what has no name shows only together with what was held out. `parted`: where the
// truth and the wheels are known to part, which is left out. `by_names`: what these leave has no say.
Result<Diagnosis> diagnosed(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                            const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress,
                            bool* shows_beside_held_out = nullptr, const Incidents& parted = {},
                            bool by_names = false) {
  const Vehicle as_mounted = turned_as_driven(with_wheels(train, nominal), nominal);
  Result<Looked> looked = looked_at_as_is(train, held_out, as_mounted, options, progress, parted.of_each);
  if (!looked) return looked.error();
  // What one counter's lateness was taken for is asked again as if both were read at once.
  OlderCounts older = looked->sought.names.older_counts;
  if (const double older_s = older.right_older_s; older_s != 0.0) {
    looked = looked_at_as_is(train, held_out, as_mounted, options, progress, parted.of_each, older_s);
    if (!looked) return looked.error();
    for (const std::string& name : looked->sought.names.older_counts.instead_of)
      if (std::find(older.instead_of.begin(), older.instead_of.end(), name) == older.instead_of.end())
        older.instead_of.push_back(name);
  }
  const ReadyRecordings* const ready = &looked->ready;
  const Predictor& predictor = looked->predictor;
  const SoughtNames* const sought = &looked->sought;
  const JointModel& calibrated = sought->calibrated;
  const Named& names = sought->names;
  const JointModel& joint = names.joint;
  FittedNoise of_calibration = ready->calibration.noise;
  of_calibration.command_timing_s = joint.model.noise.command_timing_s;  // which calibration does not know
  Adequacy adequacy =
      judged_adequacy(names, calibrated, predictor, of_calibration, kOfTheUnnamed * options.family_wise_error);
  if (by_names) {
    adequacy.unnamed.reset();
    adequacy.as_likely.reset();
  }
  if (shows_beside_held_out) *shows_beside_held_out = adequacy.shows_beside_held_out;
  // One incident that has no name hides all else.
  if (adequacy.unnamed && parted.empty()) {
    // Drawn with what is left out: there the mismatch is.
    const auto without = [&](const Incidents& incidents) {
      Result<Diagnosis> d = diagnosed(train, held_out, nominal, options, progress, shows_beside_held_out, incidents);
      if (d) d->residuals_before = residuals_of(calibrated.under(d->calibration_alone.noise));
      return d;
    };
    if (const Incidents apart = parted_stretches(*ready, as_mounted); !apart.empty()) return without(apart);
    if (const Incidents of = incidents_of(*adequacy.unnamed, train.size() + held_out.size()); !of.empty()) {
      Result<Diagnosis> beside = without(of);
      if (beside && std::none_of(beside->findings.begin(), beside->findings.end(), is_met_again)) return beside;
      if (!goes_on(progress, 0.9)) return Error{"diagnosis", "stopped before its end", ""};
    }
  }

  Diagnosis d;
  d.calibration = d.calibration_alone = ready->calibration;
  // An error of the truth that lasts is what calibration found correlated, where nothing of that is left.
  if (joint.noise_as_recorded().wander_lasts_s > 0.0 && joint.distrust() == 0.0)
    d.calibration_alone.innovations_are_correlated = false;
  // And so are clocks that run apart.
  if (std::any_of(joint.accepted.begin(), joint.accepted.end(),
                  [](const AcceptedEffect& a) { return a.effect->clock_rate; }))
    d.calibration_alone.innovations_are_correlated = ready->told().innovations_are_correlated;
  append(d.warnings, ready->warnings);
  if (!looked->names_explain_all()) append(d.warnings, ready->told().of_misfit);
  append(d.warnings, sought->of_undone);
  if (!older.instead_of.empty()) d.warnings.push_back(in_words(older));
  append(d.warnings, names.warnings);
  append(d.warnings, warnings_beside(joint, adequacy));
  d.responses = responses_of(adequacy.generic, !joint.accepted.empty());
  d.cannot_judge = joint.scalars_on_the_way() - kParameters < kFewestInnovations;

  std::vector<Finding> found = findings_of(names, adequacy, *ready, nominal);
  std::optional<JointModel> known = joint;
  if (const std::optional<Unnamed>& more = adequacy.unnamed) {
    known = beyond_doubt(names);
    found = findings_beside_unnamed(found, *more, names, known.value_or(calibrated), *ready, nominal,
                                    options.family_wise_error);
    d.responses.insert(d.responses.begin(), more->shape.begin(), more->shape.end());
    d.warnings.push_back(
        "the calibration stands beside something that it does not know: it may be off by more than its standard "
        "errors");
  }
  d.findings = found;
  add_faults(d, *ready);
  d.verdict = verdict_of(d, found, adequacy.unnamed.has_value());
  advise(d, names, options.family_wise_error);

  if (!adequacy.unnamed) d.calibration = calibration_with(joint, names.intervals, ready->told(), nominal);
  if (train.size() == 1 && held_out.empty() && !joint.accepted.empty())
    d.warnings.push_back(
        "what was found rests on one recording alone: hold out another of the same vehicle, and it is borne out or "
        "taken away");
  for (LeastSquaresCalibration* c : {&d.calibration, &d.calibration_alone})
    for (ParameterEstimate& p : c->parameters)
      if (column::of_key(p.name) == column::mounting_heading) p.nominal = nominal.truth.axle_T_tracked.heading_rad;
  const JointModel& said = known ? *known : calibrated;
  const Predicted by_said = !adequacy.unnamed ? names.by_joint
                            : known           ? predictor.of(*known, joint.model.noise)
                                              : names.by_calibrated;
  prove(d, predictor, {joint.model.noise, said, calibrated, by_said, names.by_calibrated},
        adequacy.generic.front().as_effect, train);
  if (found.empty() || !known) stand_by_calibration(d);
  draw(d, calibrated, said);
  for (const auto* runs : {&calibrated.runs(), &predictor.held_out()})
    for (const InnovationRun& run : *runs) d.judged.push_back(judged_of(run));
  name_recordings(d, train, held_out);
  if (!parted.empty()) add_parted(d, parted, *ready);
  return d;
}

// What calibration took up in the runs that were given shows beside others: fitted to all, it may have a name. `given`:
// what these say, of which each name is one that they resemble or could not have shown; else they contradict it.
std::optional<Diagnosis> named_beside_held_out(const Diagnosis& given, const std::vector<Recording>& train,
                                               const std::vector<Recording>& held_out, const Vehicle& nominal,
                                               const DiagnosisOptions& options, const Progress& progress) {
  std::vector<Recording> all = train;
  all.insert(all.end(), held_out.begin(), held_out.end());
  Result<Diagnosis> d =
      diagnosed(all, {}, nominal, options, [&](double share) { return goes_on(progress, 0.75 + 0.25 * share); });
  if (!d || (d->verdict != Verdict::found && d->verdict != Verdict::ambiguous)) return std::nullopt;
  constexpr double kTakenUp = 0.1;  // of what an effect does, that calibration leaves of it
  bool has_a_name = false;
  for (const Finding& f : d->findings) {
    if (is_of_the_truth(f.effect) || is_data_fault(f.effect)) continue;
    has_a_name = true;
    const bool is_hidden = std::any_of(given.asked.begin(), given.asked.end(), [&](const AskedEffect& a) {
      return a.effect == f.effect && a.survives.value_or(0.0) < kTakenUp;
    });
    if (!is_hidden && !is_said(f.effect, given.findings)) return std::nullopt;
    if (is_elsewhere(f, given.findings)) return std::nullopt;
  }
  if (!has_a_name) return std::nullopt;
  d->warnings.push_back(
      "the recordings given do not show what is missing, calibration takes it up; those held out were fitted too, and "
      "each run is predicted by all others instead");
  return std::move(*d);
}

}  // namespace

ActiveEffect Finding::as_active() const {
  ActiveEffect a;
  a.effect = effect;
  a.component = component;
  for (const FoundParameter& p : parameters) a.parameters.push_back({p.name, p.value});
  if (form > 0) a.parameters.push_back({"form", static_cast<double>(form)});
  return a;
}

Result<Diagnosis> diagnose_by_names(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                    const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  return diagnosed(train, held_out, nominal, options, progress, nullptr, {}, true);
}

Result<Diagnosis> diagnose(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                           const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  if (has_units(nominal)) {
    Result<Diagnosis> d = diagnose_units(train, held_out, nominal, options, progress);
    if (d) name_recordings(*d, train, held_out);
    if (d) say_over_which_way(*d, train, held_out, nominal);
    return d;
  }
  if (const std::optional<Error> other = undiagnosed_kind(nominal)) return *other;
  if (const std::vector<std::string> problems = problems_in(std::get<DifferentialDrive>(nominal.kind));
      !problems.empty())
    return Error{nominal.name, "", problems.front()};
  bool shows_beside_held_out = false;
  Result<Diagnosis> d = diagnosed(train, held_out, nominal, options, progress, &shows_beside_held_out);
  if (d && shows_beside_held_out)
    if (std::optional<Diagnosis> named = named_beside_held_out(*d, train, held_out, nominal, options, progress))
      d = std::move(*named);
  if (d) say_over_which_way(*d, train, held_out, nominal);
  return d;
}

}  // namespace odolab
