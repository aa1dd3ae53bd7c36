#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/base/chi_square.h"
#include "core/calibration/correlated_truth.h"
#include "core/calibration/moved_mounting.h"
#include "core/calibration/recording_fault.h"
#include "core/diagnosis/advice/advice.h"
#include "core/diagnosis/chosen_by_unseen.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/adequacy.h"
#include "core/diagnosis/generic/contradicted.h"
#include "core/diagnosis/generic/responses.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/model/ready_run.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/proof.h"
#include "core/diagnosis/quality.h"
#include "core/diagnosis/units/diagnose_units.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/diagnosis/where.h"

namespace odolab {

namespace {

constexpr int kFewestInnovations = 40;  // beyond the parameters: fewer cannot judge a model

std::string text(const char* format, double a = 0.0, double b = 0.0, double c = 0.0) {
  char buffer[300];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

// Well away from nothing and, where it is one moment, from all that is left out and from both ends of its recording.
bool stands_out(const JointModel& joint, const AcceptedEffect& a) {
  constexpr double kLeastSigmas = 3.0;
  if (a.effect->local && a.effect->of_one_recording && !joint.is_well_inside(static_cast<int>(a.shape[0]), a.shape[1]))
    return false;
  for (std::size_t k = 0; k < a.value.size(); ++k)
    if (std::abs(a.value[k]) > kLeastSigmas * a.stderr_value[k]) return true;
  return false;
}

std::string in_words(const Finding& f) {
  std::string s = f.sentence;
  for (std::size_t k = 0; k < std::min<std::size_t>(f.parameters.size(), 3); ++k) {
    const FoundParameter& p = f.parameters[k];
    s += (k == 0 ? " (" : ", ") + p.name + text(" %.4g +- %.2g", p.value, p.stderr_value) +
         (p.unit == "1" ? "" : " " + p.unit);
  }
  if (!f.parameters.empty()) s += ")";
  return s;
}

Finding finding_of(const JointModel& joint, const AcceptedEffect& a, const Eigen::MatrixXd& covariance,
                   const ScoredCandidate& evidence, const std::vector<ScoredCandidate>& alternatives) {
  Finding f;
  f.effect = a.effect->name;
  f.component = a.effect->component;
  f.parameters = parameters_of(a, covariance);
  f.where = where_of(joint, a, covariance);
  f.log_likelihood_gain = 0.5 * evidence.test.statistic;
  f.p_value = evidence.p_value;
  f.sentence = a.effect->sentence;
  if (a.effect->forms.size() > 1) {
    f.form = static_cast<int>(a.shape.back());
    f.form_in_words = a.effect->forms[static_cast<std::size_t>(f.form)];
  }
  for (const ScoredCandidate& c : alternatives)
    f.alternatives.push_back({c.effect->name, c.effect->component, 0.5 * c.test.statistic, c.effect->told_apart_by});
  return f;
}

// Names that did not suffice are said as what it resembles, not as what it is.
Finding unknown_of(const Unnamed& more, double explained, const JointModel& joint,
                   const std::vector<ScoredCandidate>& evidence) {
  Finding unknown;
  unknown.effect = "unknown";
  unknown.component = "vehicle";
  unknown.where = more.where;
  unknown.log_likelihood_gain = 0.5 * (explained + more.gain);
  unknown.p_value = more.p_value;
  unknown.share_of_mismatch = more.share;
  unknown.sentence = "something that no entry of the catalogue describes: " + unknown.where.regime;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k)
    unknown.alternatives.push_back({joint.accepted[k].effect->name, joint.accepted[k].effect->component,
                                    0.5 * evidence[k].test.statistic, joint.accepted[k].effect->told_apart_by});
  return unknown;
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

// How many names the catalogue has for a vehicle that has encoders.
std::size_t entries_for_encoders() {
  std::set<std::string> names;
  for (const Effect& e : catalogue())
    if (!e.only_commands) names.insert(e.name);
  return names.size();
}

const char* headline(Verdict verdict) {
  switch (verdict) {
    case Verdict::found:
      return "Something is missing from the model, and it has a name:";
    case Verdict::nothing_missing:
      return "Nothing is missing: calibration leaves nothing but noise.";
    case Verdict::unknown_effect:
      return "Something is missing that no entry of the catalogue describes.";
    case Verdict::ambiguous:
      return "Something is missing; these recordings do not decide between the names given.";
    case Verdict::cannot_say:
      break;
  }
  return "These recordings are too poor to judge whether anything is missing.";
}

// Whether names suffice, of what they were fitted to; and of that together with what was held out, half the error each.
Adequacy judged_adequacy(const JointModel& joint, const JointModel& calibrated, const Predictor& predictor,
                         std::vector<ScoredCandidate> evidence, double of_mounting, double error) {
  const std::optional<JointModel> all_named = predictor.fitted_to_all(joint);
  Adequacy adequacy = adequacy_of(joint, calibrated, evidence, of_mounting, all_named ? 0.5 * error : error);
  if (adequacy.unnamed || !all_named) return adequacy;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const AcceptedEffect& a = all_named->accepted[k];
    const double of_all = all_named->test(all_named->columns_of(*a.effect, a.shape), static_cast<int>(k)).statistic;
    evidence[k].test.statistic = std::max(evidence[k].test.statistic, of_all);
  }
  const JointModel all_calibrated = *predictor.fitted_to_all(calibrated);
  const Adequacy of_all = adequacy_of(*all_named, all_calibrated, evidence, of_mounting, 0.5 * error);
  adequacy.unnamed = of_all.unnamed;
  if (!adequacy.unnamed)
    adequacy.unnamed = what_was_not_foreseen(*all_named, all_calibrated, static_cast<int>(joint.runs().size()));
  if (of_all.as_likely) adequacy.as_likely = of_all.as_likely;
  return adequacy;
}

std::vector<double> inflations_of(const Selected& selected) {
  std::vector<double> inflations;
  for (const ScoredCandidate& e : selected.evidence) inflations.push_back(e.test.inflation);
  return inflations;
}

std::string of_refuted(const Effect& effect) {
  std::string name = effect.name + " of the " + effect.component;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + " would describe the recordings that were fitted, but what was not fitted is predicted worse with it";
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

Result<Diagnosis> diagnose(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                           const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  if (has_units(nominal)) return diagnose_units(train, held_out, nominal, options, progress);
  if (const std::optional<Error> other = undiagnosed_kind(nominal)) return *other;
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (const std::vector<std::string> problems = problems_in(*drive); !problems.empty())
    return Error{nominal.name, "", problems.front()};
  if (train.empty()) return Error{"recordings", "none", "one or more"};

  Diagnosis d;
  std::vector<CheckedRecording> ready, ready_held_out;
  std::vector<Recording> clean;
  std::vector<std::string> names;
  bool from_commands = false;
  for (const Recording& r : train) {
    if (const std::vector<std::string> problems = problems_in(r); !problems.empty())
      return Error{r.name.empty() ? "recording" : r.name, "", problems.front()};
    ready.push_back(checked(r, nominal));
    clean.push_back(ready.back().recording);
    names.push_back(r.name);
    from_commands = from_commands || ready.back().from_commands;
  }
  for (const Recording& r : held_out) {
    if (const std::vector<std::string> problems = problems_in(r); !problems.empty())
      return Error{r.name.empty() ? "recording" : r.name, "", problems.front()};
    ready_held_out.push_back(checked(r, nominal));
  }
  const Error stopped{"diagnosis", "stopped before its end", ""};
  std::vector<CheckedRecording*> each;
  for (std::vector<CheckedRecording>* of : {&ready, &ready_held_out})
    for (CheckedRecording& c : *of) each.push_back(&c);
  std::vector<Recording> all_recordings;
  for (const CheckedRecording* c : each) all_recordings.push_back(c->recording);
  for (const std::optional<Error>& fault : faults_in(all_recordings, nominal))
    if (fault) return *fault;
  const PutRight put_right =
      mountings_put_right(all_recordings, nominal, [&](double) { return goes_on(progress, 0.0); });
  for (const MovedMounting& m : put_right.moved) {
    each[m.index]->recording = put_right.recordings[m.index];
    if (m.index < clean.size()) clean[m.index] = put_right.recordings[m.index];
  }
  const Progress calibrating = [&](double share) { return goes_on(progress, 0.25 * share); };
  LeastSquaresOptions with_faults_left_out;
  for (const CheckedRecording& c : ready) with_faults_left_out.left_out.push_back(c.left_out_s);
  Result<LeastSquaresCalibration> calibration =
      calibrate_least_squares(clean, nominal, with_faults_left_out, calibrating);
  if (!calibration) return calibration.error();
  d.calibration = d.calibration_alone = *calibration;
  for (const std::vector<CheckedRecording>* set : {&ready, &ready_held_out})
    for (const CheckedRecording& c : *set) d.warnings.insert(d.warnings.end(), c.warnings.begin(), c.warnings.end());
  d.warnings.insert(d.warnings.end(), calibration->warnings.begin(), calibration->warnings.end());
  if (calibration->truth_apart_s > 0.0)
    for (std::vector<CheckedRecording>* checked : {&ready, &ready_held_out})
      for (CheckedRecording& c : *checked) c.recording = with_truth_apart(c.recording, calibration->truth_apart_s);

  std::vector<InnovationRun> runs;
  std::vector<char> commands;
  for (const CheckedRecording& c : ready) {
    Result<InnovationRun> run = ready_run(c, nominal);
    if (!run) return run.error();
    runs.push_back(std::move(*run));
    commands.push_back(c.from_commands);
  }
  JointModel joint(std::move(runs), commands, *calibration, nominal);
  joint.truth_noise_lasts = calibration->truth_apart_s > 0.0;
  joint.linearise();
  joint.gate();
  joint.fit(3);
  joint.fit_noise_and_all();
  const JointModel calibrated = joint;
  if (!goes_on(progress, 0.3)) return stopped;

  Selected selected = select_effects(joint, options.family_wise_error, progress);
  if (!goes_on(progress, 0.75)) return stopped;

  const Predictor predictor(ready_held_out, d.calibration_alone, nominal);
  choose_by_unseen(predictor, joint, selected);
  // Where nothing was let in to stay, nothing that was tried may have moved the calibration and the noise.
  if (joint.accepted.empty()) joint = calibrated;
  Intervals intervals = refined(joint, inflations_of(selected));
  // What is not well away from nothing once its place and time are uncertain too is no finding, nor is what runs that
  // it was not fitted to refute.
  Predicted by_calibrated, by_joint;
  const auto untenable = [&]() -> std::optional<std::size_t> {
    for (std::size_t k = joint.accepted.size(); k-- > 0;)
      if (!stands_out(joint, joint.accepted[k])) return k;
    by_calibrated = predictor.of(calibrated, joint.model.noise);
    by_joint = joint.accepted.empty() ? by_calibrated : predictor.of(joint, joint.model.noise);
    const std::optional<std::size_t> k = refuted(predictor, joint, by_joint, by_calibrated);
    if (k) d.warnings.push_back(of_refuted(*joint.accepted[*k].effect));
    return k;
  };
  constexpr std::size_t kMostUntenable = 2;
  std::vector<const Effect*> untenables;
  while (const std::optional<std::size_t> k = untenable()) {
    untenables.push_back(joint.accepted[*k].effect);
    const auto at = static_cast<std::ptrdiff_t>(*k);
    joint.accepted.erase(joint.accepted.begin() + at);
    selected.evidence.erase(selected.evidence.begin() + at);
    selected.alternatives.erase(selected.alternatives.begin() + at);
    if (joint.accepted.empty()) joint = calibrated;
    if (joint.accepted.empty() && untenables.size() < kMostUntenable) {  // what it stood for may have another name
      selected = select_effects(
          joint, options.family_wise_error, [&](double) { return goes_on(progress, 0.75); }, untenables);
      if (!goes_on(progress, 0.75)) return stopped;
      if (joint.accepted.empty()) joint = calibrated;
    } else if (!joint.accepted.empty()) {
      joint.fit(3);
      joint.fit_noise_and_all();
    }
    intervals = refined(joint, inflations_of(selected));
  }

  std::vector<Finding> named;
  double explained = 0.0;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    named.push_back(
        finding_of(joint, joint.accepted[k], intervals.of_effect[k], selected.evidence[k], selected.alternatives[k]));
    explained += selected.evidence[k].test.statistic;
  }
  add_mounting(named, joint, intervals, d.calibration_alone, nominal);
  add_clock(named, joint, d.calibration_alone, nominal, from_commands);

  // Wheels that do not stand square to the axle also slip in turns: that much belongs to them.
  double of_toe = 0.0;
  for (const Finding& f : named)
    if (f.effect == "wheel_toe") of_toe += 2.0 * f.log_likelihood_gain;
  Adequacy adequacy =
      judged_adequacy(joint, calibrated, predictor, selected.evidence, of_toe, 0.25 * options.family_wise_error);
  if (!adequacy.unnamed) adequacy.unnamed = what_contradicts(joint, calibrated, d.calibration_alone.noise);
  if (!adequacy.unnamed) adequacy.unnamed = what_happens_too_often(joint);
  if (!adequacy.unnamed) adequacy.unnamed = what_scatters_too_much(joint);
  if (adequacy.something_small_is_left)
    d.warnings.push_back(
        "beside the names given something small is left that no name describes, or the truth's noise is not white");
  d.responses = responses_of(adequacy.generic, !joint.accepted.empty());

  const double all = std::max(1e-9, explained + (adequacy.unnamed ? adequacy.unnamed->gain : 0.0));
  for (std::size_t k = 0; k < joint.accepted.size(); ++k)
    named[k].share_of_mismatch = std::clamp(selected.evidence[k].test.statistic / all, 0.0, 1.0);
  std::sort(named.begin(), named.end(),
            [](const Finding& a, const Finding& b) { return a.log_likelihood_gain > b.log_likelihood_gain; });
  if (adequacy.as_likely && !named.empty())
    named.front().alternatives.push_back(
        {"unknown", "vehicle", 0.5 * std::max(0.0, adequacy.as_likely->gain + explained),
         "the same ways driven in another order (it may be " + adequacy.as_likely->where.regime + ")"});
  bool ambiguous = false;
  for (const Finding& f : named) ambiguous = ambiguous || !f.alternatives.empty();

  if (const std::optional<Unnamed>& more = adequacy.unnamed) {
    d.responses.insert(d.responses.begin(), more->shape.begin(), more->shape.end());
    const Finding unknown = unknown_of(*more, explained, joint, selected.evidence);
    named.erase(std::remove_if(
                    named.begin(), named.end(),
                    [](const Finding& f) { return f.effect.rfind("truth_", 0) != 0 && f.effect != "actuator_delay"; }),
                named.end());
    named.insert(named.begin(), unknown);
    d.verdict = Verdict::unknown_effect;
  } else if (!named.empty()) {
    d.verdict = ambiguous ? Verdict::ambiguous : Verdict::found;
  } else {
    const double freedom = joint.scalars() - 7.0;
    d.verdict = freedom < kFewestInnovations ? Verdict::cannot_say : Verdict::nothing_missing;
  }
  d.findings = named;
  for (const CheckedRecording& c : ready)
    for (const DataFault& fault : c.faults) {
      Finding f;
      f.effect = fault.effect;
      f.component = fault.component;
      f.where.recording = fault.recording;
      f.where.time_s = fault.time_s;
      f.p_value = 0.0;
      f.sentence = fault.sentence;
      d.findings.push_back(f);
    }
  for (const MovedMounting& m : put_right.moved) d.findings.push_back(finding_of(m));
  if (d.verdict == Verdict::nothing_missing && !d.findings.empty()) d.verdict = Verdict::found;
  const std::vector<Confusion> confused =
      d.verdict == Verdict::ambiguous ? confusions(joint, selected) : std::vector<Confusion>{};
  const Advice next = advice(joint, confused, options.family_wise_error);
  d.not_testable = next.not_testable;
  // Less than a third of them could show.
  if (d.verdict == Verdict::nothing_missing && 3 * d.not_testable.size() > 2 * entries_for_encoders())
    d.verdict = Verdict::cannot_say;

  if (d.verdict != Verdict::unknown_effect)
    d.calibration = calibration_with(joint, intervals, d.calibration_alone, nominal);
  if (clean.size() == 1 && held_out.empty() && !joint.accepted.empty())
    d.warnings.push_back(
        "what was found rests on one recording alone: hold out another of the same vehicle, and it is borne out or "
        "taken away");
  prove(d, predictor, joint, calibrated, by_joint, by_calibrated, adequacy.generic.front().as_effect, train);
  if (named.empty()) {  // then the calibration alone is the model, to the last digit
    d.calibration = d.calibration_alone;
    d.fitted_vehicle = d.calibration_alone.vehicle;
    const std::vector<double>& clocks = d.calibration_alone.time_offset_s;
    for (std::size_t r = 0; r < std::min(clocks.size(), d.truth_clock_s.size()); ++r)
      d.truth_clock_s[r].second = clocks[r];
  }
  d.residuals_before = residuals_of(calibrated);
  d.residuals_after = residuals_of(joint);

  for (const Finding& f : d.findings)
    if (!f.alternatives.empty() && d.next_drive.empty()) d.next_drive = f.alternatives.front().told_apart_by;
  if (!confused.empty() || d.next_drive.empty()) {
    d.next_drive = next.next_drive;
    d.next_legs = next.next_legs;
  }

  d.sentences.push_back(headline(d.verdict));
  for (const Finding& f : d.findings) {
    d.sentences.push_back(in_words(f));
    for (const Alternative& a : f.alternatives)
      d.sentences.push_back("  or " + a.effect + " (" + a.component + "); told apart by " + a.told_apart_by);
  }
  if (!d.next_drive.empty()) d.sentences.push_back("Drive next: " + d.next_drive + ".");
  return d;
}

}  // namespace odolab
