#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/diagnosis/advice/advice.h"
#include "core/diagnosis/asked_effects.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/gathered_evidence.h"
#include "core/diagnosis/generic/adequacy.h"
#include "core/diagnosis/generic/responses.h"
#include "core/diagnosis/judged_adequacy.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/mismatch.h"
#include "core/diagnosis/model/coarse_counts.h"
#include "core/diagnosis/model/driven_again.h"
#include "core/diagnosis/moved_track.h"
#include "core/diagnosis/named.h"
#include "core/diagnosis/place_response.h"
#include "core/diagnosis/ready_recordings.h"
#include "core/diagnosis/sentences.h"
#include "core/diagnosis/units/diagnose_units.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/diagnosis/where.h"

namespace odolab {

namespace {

constexpr double kOfTheUnnamed = 0.25;  // of the family-wise error of names, that something without one may have

std::string in_words(const Undone& u, const std::string& recording) {
  return recording + formatted(": from %.2f to %.2f s the truth is elsewhere", u.from_s, u.to_s) +
         formatted(" by %.2g mm and %.2g degrees, and then back", 1e3 * u.away_m,
                   std::abs(u.turned_rad) * 180.0 / kPi) +
         ", as where a tracker loses a marker or the vehicle gives way; left out";
}

Finding finding_of(const JointModel& joint, const AcceptedEffect& a, const Eigen::MatrixXd& covariance,
                   const ScoredCandidate& evidence, const std::vector<ScoredCandidate>& alternatives) {
  Finding f;
  f.effect = a.effect->name;
  f.component = a.effect->component;
  f.parameters = parameters_of(a, covariance, joint.views());
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

// Clocks that run apart beyond doubt are known, whatever else has no name: nothing that a vehicle does is like them.
bool is_beyond_doubt(const ScoredCandidate& evidence) {
  return evidence.effect->clock_rate && evidence.test.statistic > kDecisive;
}

bool is_known_clock(const Finding& f) { return f.effect == "clock_rate" && 2.0 * f.log_likelihood_gain > kDecisive; }

// Whether calibration by itself has the tracked point elsewhere than the vehicle's file, beyond chance.
bool calibration_moved_the_mounting(const LeastSquaresCalibration& fit, const Vehicle& nominal) {
  const Pose& then = nominal.truth.axle_T_tracked;
  const std::pair<const char*, double> of_file[] = {{"truth_mounting.x_m", then.x_m},
                                                    {"truth_mounting.y_m", then.y_m},
                                                    {"truth_mounting.heading_rad", then.heading_rad}};
  return std::any_of(std::begin(of_file), std::end(of_file), [&](const auto& of) {
    return std::any_of(fit.parameters.begin(), fit.parameters.end(), [&](const ParameterEstimate& p) {
      return p.name == of.first && p.determined && std::abs(p.value - of.second) > kSigmasOfBias * p.stderr_value;
    });
  });
}

// The model with what is beyond doubt; unset where nothing is.
std::optional<JointModel> beyond_doubt(const JointModel& joint, const std::vector<ScoredCandidate>& evidence) {
  JointModel known = joint;
  known.accepted.clear();
  for (std::size_t k = 0; k < joint.accepted.size(); ++k)
    if (is_beyond_doubt(evidence[k])) known.accepted.push_back(joint.accepted[k]);
  if (known.accepted.empty()) return std::nullopt;
  known.fit(2);
  return known;
}

// Names that did not suffice are said as what it resembles, not as what it is.
Finding unknown_of(const Unnamed& more, const JointModel& joint, const std::vector<ScoredCandidate>& evidence) {
  Finding unknown;
  unknown.effect = "unknown";
  unknown.component = more.component;
  unknown.where = more.where;
  unknown.gathered = more.gathered;
  unknown.log_likelihood_gain = 0.5 * more.gain;
  unknown.p_value = more.p_value;
  unknown.sentence = "something that no entry of the catalogue describes: " + unknown.where.regime;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const Effect& e = *joint.accepted[k].effect;
    const double statistic = evidence[k].test.statistic;
    if (is_beyond_doubt(evidence[k])) continue;
    unknown.log_likelihood_gain += 0.5 * statistic;
    unknown.alternatives.push_back({e.name, e.component, 0.5 * statistic, e.told_apart_by});
  }
  return unknown;
}

// What comes nearest to it of the catalogue, where no name was let in: what lasts, and stands by the likelihood alone.
void add_nearest(Finding& unknown, const std::vector<ScoredCandidate>& first_look, double family_wise_error) {
  for (const ScoredCandidate& c : first_look)
    if (!c.effect->local && c.beyond_counts && c.p_value < family_wise_error && c.test.cross_validated > 0.0) {
      unknown.alternatives.push_back(
          {c.effect->name, c.effect->component, 0.5 * c.test.judged(), c.effect->told_apart_by});
      return;
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

// `shows_beside_held_out`: whether what has no name shows only together with what was held out.
Result<Diagnosis> diagnosed(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                            const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress,
                            bool* shows_beside_held_out = nullptr) {
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  const Error stopped{"diagnosis", "stopped before its end", ""};
  const Result<ReadyRecordings> ready =
      ready_recordings(train, held_out, nominal, [&](double share) { return goes_on(progress, 0.25 * share); });
  if (!ready) return ready.error();
  Result<JointModel> calibrated_only = calibrated_model(*ready, nominal);
  if (!calibrated_only) return calibrated_only.error();
  if (!goes_on(progress, 0.3)) return stopped;

  Diagnosis d;
  d.calibration = d.calibration_alone = ready->calibration;
  d.warnings = ready->warnings;
  const Predictor predictor(ready->held_out, d.calibration_alone, nominal);
  JointModel calibrated = *calibrated_only;
  std::optional<Named> names;
  std::vector<std::string> of_undone;
  const auto are_sought = [&](const JointModel& from) {
    calibrated = from;
    calibrated.truth_errors = options.truth_errors;
    calibrated.driven_again = std::make_shared<const DrivenAgain>(calibrated, counts_may_feign(calibrated));
    calibrated.truth_feigns_m = options.truth_step_m + 0.5 * drive->wheelbase_m * options.truth_step_rad;
    of_undone.clear();
    // A truth that is somewhere else for a while shows nothing of the vehicle. What does so time and again is no
    // mishap.
    constexpr int kMostUndone = 3;
    for (int left_out = 0;; ++left_out) {
      names = named(calibrated, predictor, options.family_wise_error, progress, left_out < kMostUndone);
      if (!names) return false;
      if (!names->selected.undone) return true;
      const Undone& u = *names->selected.undone;
      of_undone.push_back(in_words(u, ready->train[static_cast<std::size_t>(u.run)].recording.name));
      calibrated.leave_out(u.run, u.from_s, u.to_s);
      calibrated.fit(2);
      calibrated.fit_noise_and_all();
    }
  };
  if (!are_sought(*calibrated_only)) return stopped;
  // What seemed a truth that comes back has names now: they are sought as if it never did.
  if (calibrated.model.noise.wander_lasts_s > 0.0 && names->joint.model.noise.wander_lasts_s == 0.0) {
    calibrated_only = calibrated_model(*ready, nominal, false);
    if (!calibrated_only) return calibrated_only.error();
    if (!are_sought(*calibrated_only)) return stopped;
  }
  d.warnings.insert(d.warnings.end(), of_undone.begin(), of_undone.end());
  const auto& [joint, selected, intervals, by_joint, by_calibrated, with_held_out, of_refuted] = *names;
  d.warnings.insert(d.warnings.end(), of_refuted.begin(), of_refuted.end());

  std::vector<Finding> found;
  double explained = 0.0;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    found.push_back(
        finding_of(joint, joint.accepted[k], intervals.of_effect[k], selected.evidence[k], selected.alternatives[k]));
    explained += selected.evidence[k].test.statistic;
  }
  add_mounting(found, joint, intervals, d.calibration_alone, nominal);
  add_clock(found, joint, intervals, d.calibration_alone, nominal, ready->from_commands);

  FittedNoise of_calibration = d.calibration_alone.noise;
  of_calibration.command_timing_s = joint.model.noise.command_timing_s;  // which calibration does not know
  const Adequacy adequacy =
      judged_adequacy(*names, calibrated, predictor, of_calibration, kOfTheUnnamed * options.family_wise_error);
  if (shows_beside_held_out) *shows_beside_held_out = adequacy.shows_beside_held_out;
  if (adequacy.something_small_is_left)
    d.warnings.push_back(
        "beside the names given something small is left that no name describes, or the truth's noise is not white");
  for (const Adequacy::Ripple& r : adequacy.ripples)
    d.warnings.push_back("the " + r.channel.substr(0, r.channel.find(" per metre")) +
                         formatted(" comes and goes %.3g times a turn, by ", r.times_a_turn) +
                         formatted("%.2g %% of it, as a gear before it makes it do; it adds up to nothing over any way",
                                   100.0 * r.amplitude));
  constexpr double kUneven_s = 0.02;
  if (const double timing_s = joint.model.noise.command_timing_s; timing_s > kUneven_s)
    d.warnings.push_back(
        formatted("the base acts on each change of its command %.2g s sooner or later than on another, as "
                  "where it asks for commands every so often: that is taken for noise",
                  timing_s));
  if (const FittedNoise noise = joint.noise_as_recorded(); noise.wander_lasts_s > 0.0) {
    const double spread = std::sqrt(0.5 * noise.wander_lasts_s);
    const double off_rad = spread * noise.heading_wander_rad_per_sqrt_s;
    d.warnings.push_back(formatted("the truth's error lasts for about %.2g s: ", noise.wander_lasts_s) +
                         formatted("%.2g mm", 1e3 * spread * noise.wander_m_per_sqrt_s) +
                         (off_rad > 0.0 ? formatted(" and %.2g degrees", off_rad * 180.0 / kPi) : "") +
                         formatted(" of it, beside %.2g mm from one sample to the next; this is reckoned with",
                                   1e3 * noise.truth_position_m));
    // Which was what calibration found correlated, where nothing of that is left.
    if (joint.distrust() == 0.0) d.calibration_alone.innovations_are_correlated = false;
  }
  if (adequacy.sway)
    d.warnings.push_back(
        "the vehicle, or the truth by itself, comes and goes by " +
        formatted("%.2g mm to either side with ", 1e3 * adequacy.sway->to_either_side_m) + adequacy.sway->wave +
        ": no more than one sample of the truth errs, so which of both it is cannot be told; a stop of "
        "two such waves would");
  d.responses = responses_of(adequacy.generic, !joint.accepted.empty());

  const double all = std::max(1e-9, explained + (adequacy.unnamed ? adequacy.unnamed->gain : 0.0));
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    found[k].share_of_mismatch = std::clamp(selected.evidence[k].test.statistic / all, 0.0, 1.0);
    if (adequacy.unnamed) continue;
    found[k].moves = moved_by(joint, k);
    found[k].gathered = gathered_evidence(joint, k, found[k].log_likelihood_gain);
  }
  std::sort(found.begin(), found.end(), comes_first);
  if (adequacy.as_likely && !found.empty())
    found.front().alternatives.push_back(
        {"unknown", "vehicle", 0.5 * adequacy.as_likely->gain,
         "the same ways driven in another order (it may be " + adequacy.as_likely->where.regime + ")"});
  bool ambiguous = false;
  for (const Finding& f : found) ambiguous = ambiguous || !f.alternatives.empty();

  d.cannot_judge = joint.scalars_on_the_way() - kParameters < kFewestInnovations;
  const std::optional<JointModel> known = adequacy.unnamed ? beyond_doubt(joint, selected.evidence) : joint;
  if (const std::optional<Unnamed>& more = adequacy.unnamed) {
    d.responses.insert(d.responses.begin(), more->shape.begin(), more->shape.end());
    Finding unknown = unknown_of(*more, joint, selected.evidence);
    unknown.share_of_mismatch = std::min(1.0, 2.0 * unknown.log_likelihood_gain / all);
    if (unknown.alternatives.empty()) add_nearest(unknown, selected.first_look, options.family_wise_error);
    std::erase_if(found, [&](const Finding& f) { return !is_known_clock(f); });
    // Where the point sits and how the clocks go as it is without the names that did not suffice.
    JointModel without = known.value_or(calibrated);
    const Intervals of_it = refined(without, std::vector<double>(without.accepted.size(), 1.0));
    if (calibration_moved_the_mounting(d.calibration_alone, nominal))
      add_mounting(found, without, of_it, d.calibration_alone, nominal);
    add_clock(found, without, of_it, d.calibration_alone, nominal, ready->from_commands);
    found.insert(found.begin(), unknown);
    d.verdict = Verdict::unknown_effect;
    d.warnings.push_back(
        "the calibration stands beside something that it does not know: it may be off by more than its standard "
        "errors");
  } else if (!found.empty()) {
    d.verdict = ambiguous ? Verdict::ambiguous : Verdict::found;
  } else {
    d.verdict = d.cannot_judge ? Verdict::cannot_say : Verdict::nothing_missing;
  }
  d.findings = found;
  for (const CheckedRecording& c : ready->train)
    for (const DataFault& fault : c.faults) d.findings.push_back(finding_of(fault));
  for (const CheckedRecording& c : ready->held_out)  // they give no finding
    for (const DataFault& fault : c.faults) d.warnings.push_back(in_words(fault));
  for (const MovedMounting& m : ready->moved) d.findings.push_back(finding_of(m));
  if (d.verdict == Verdict::nothing_missing && !d.findings.empty()) d.verdict = Verdict::found;
  const std::vector<Confusion> confused =
      d.verdict == Verdict::ambiguous ? confusions(joint, selected) : std::vector<Confusion>{};
  const std::vector<Visible> looks = visible(joint, options.family_wise_error);
  const Advice next = advice(joint, confused, unseen(looks));
  d.asked = asked_effects(joint, selected, looks);
  d.not_testable = next.not_testable;
  std::erase_if(d.not_testable, [&](const NotTestable& n) { return is_said(n.effect, d.findings); });
  d.cannot_judge = d.cannot_judge || are_most_effects(d.not_testable);
  if (d.verdict == Verdict::nothing_missing && d.cannot_judge) d.verdict = Verdict::cannot_say;

  if (d.verdict != Verdict::unknown_effect)
    d.calibration = calibration_with(joint, intervals, d.calibration_alone, nominal);
  if (train.size() == 1 && held_out.empty() && !joint.accepted.empty())
    d.warnings.push_back(
        "what was found rests on one recording alone: hold out another of the same vehicle, and it is borne out or "
        "taken away");
  const JointModel& said = known ? *known : calibrated;
  const Predicted by_said = !adequacy.unnamed ? by_joint
                            : known           ? predictor.of(*known, joint.model.noise)
                                              : by_calibrated;
  prove(d, predictor, {joint.model.noise, said, calibrated, by_said, by_calibrated}, adequacy.generic.front().as_effect,
        train);
  if (found.empty() || !known) {  // then the calibration alone is the model, to the last digit
    d.calibration = d.calibration_alone;
    d.fitted_vehicle = d.calibration_alone.vehicle;
    const std::vector<double>& clocks = d.calibration_alone.time_offset_s;
    for (std::size_t r = 0; r < std::min(clocks.size(), d.truth_clock_s.size()); ++r)
      d.truth_clock_s[r].second = clocks[r];
  }
  const FittedNoise between = noise_of_pictures(calibrated.model.noise, said.model.noise);
  d.residuals_before = residuals_of(calibrated.under(between));
  d.residuals_after = residuals_of(said.under(between));
  if (!d.findings.empty() && d.findings.front().where.zone) {
    const Finding& first = d.findings.front();
    Response about = zone_response(*first.where.zone, first.effect == "bump" ? "bump" : "patch", d.residuals_before,
                                   d.residuals_after);
    if (!about.at.empty()) d.responses.insert(d.responses.begin(), std::move(about));
  }

  for (const Finding& f : d.findings)
    if (!f.alternatives.empty() && d.next_drive.empty()) d.next_drive = f.alternatives.front().told_apart_by;
  if (!confused.empty() || d.next_drive.empty()) {
    d.next_drive = next.next_drive;
    d.next_legs = next.next_legs;
  }

  d.sentences = sentences_of(d);
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
      diagnosed(all, {}, nominal, options, [&](double share) { return goes_on(progress, 0.5 + 0.5 * share); });
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

Result<Diagnosis> diagnose(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                           const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  if (has_units(nominal)) return diagnose_units(train, held_out, nominal, options, progress);
  if (const std::optional<Error> other = undiagnosed_kind(nominal)) return *other;
  if (const std::vector<std::string> problems = problems_in(std::get<DifferentialDrive>(nominal.kind));
      !problems.empty())
    return Error{nominal.name, "", problems.front()};
  bool shows_beside_held_out = false;
  Result<Diagnosis> d = diagnosed(train, held_out, nominal, options, progress, &shows_beside_held_out);
  if (!d || !shows_beside_held_out) return d;
  std::optional<Diagnosis> named = named_beside_held_out(*d, train, held_out, nominal, options, progress);
  return named ? std::move(*named) : std::move(d);
}

}  // namespace odolab
