#include "core/diagnosis/findings_of.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/gathered_evidence.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/moved_track.h"
#include "core/diagnosis/where.h"

namespace odolab {

namespace {

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

// All that names and what has none explain, as twice a gain in log-likelihood.
double mismatch_of(const Named& names, const std::optional<Unnamed>& unnamed) {
  double explained = 0.0;
  for (const ScoredCandidate& evidence : names.selected.evidence) explained += evidence.test.statistic;
  return std::max(1e-9, explained + (unnamed ? unnamed->gain : 0.0));
}

// Names that did not suffice are said as what it resembles, not as what it is.
Finding unknown_of(const Unnamed& more, const Named& names) {
  Finding unknown;
  unknown.effect = "unknown";
  unknown.component = more.component;
  unknown.where = more.where;
  unknown.gathered = more.gathered;
  unknown.moves = more.moves;
  unknown.log_likelihood_gain = 0.5 * more.gain;
  unknown.p_value = more.p_value;
  unknown.sentence = "something that no entry of the catalogue describes: " + unknown.where.regime;
  for (const ScoredCandidate& evidence : names.selected.evidence) {
    if (is_beyond_doubt(evidence)) continue;
    const Effect& e = *evidence.effect;
    const double gain = 0.5 * evidence.test.statistic;
    unknown.log_likelihood_gain += gain;
    unknown.alternatives.push_back({e.name, e.component, gain, e.told_apart_by});
  }
  unknown.share_of_mismatch = std::min(1.0, 2.0 * unknown.log_likelihood_gain / mismatch_of(names, more));
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

// Of what one wheel does by its angle, a look tells what no drive does.
void look_at_the_wheel(Finding& unknown) {
  const char* wheel = unknown.component == component_of(Wheel::left)    ? "left"
                      : unknown.component == component_of(Wheel::right) ? "right"
                                                                        : nullptr;
  if (!wheel || unknown.where.regime.find(" that depends on its angle") == std::string::npos) return;
  for (Alternative& a : unknown.alternatives)
    if (a.component == unknown.component)
      a.told_apart_by = std::string("a look at the ") + wheel + " wheel while it is turned by hand";
}

}  // namespace

void leave_out_what_it_hardly_resembles(Finding& unknown) {
  constexpr double kLeastAlike = 0.25;  // of the evidence; of several pushes that of all
  const std::vector<Alternative> all = unknown.alternatives;
  std::erase_if(unknown.alternatives, [&](const Alternative& a) {
    double gain = 0.0;
    for (const Alternative& b : all)
      if (b.effect == a.effect && b.component == a.component) gain += b.log_likelihood_gain;
    return gain < kLeastAlike * unknown.log_likelihood_gain;
  });
}

std::vector<Finding> findings_of(const Named& names, const Adequacy& adequacy, const ReadyRecordings& ready,
                                 const Vehicle& nominal) {
  const JointModel& joint = names.joint;
  const Selected& selected = names.selected;
  const double all = mismatch_of(names, adequacy.unnamed);
  std::vector<Finding> findings;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    Finding f = finding_of(joint, joint.accepted[k], names.intervals.of_effect[k], selected.evidence[k],
                           selected.alternatives[k]);
    f.share_of_mismatch = std::clamp(selected.evidence[k].test.statistic / all, 0.0, 1.0);
    if (!adequacy.unnamed) {
      f.moves = moved_by(joint, k);
      f.gathered = gathered_evidence(joint, k, f.log_likelihood_gain);
    }
    findings.push_back(std::move(f));
  }
  add_mounting(findings, joint, names.intervals, ready.told(), nominal);
  add_clock(findings, joint, names.intervals, ready.told(), nominal, ready.from_commands);
  std::sort(findings.begin(), findings.end(), comes_first);
  if (adequacy.as_likely && !findings.empty())
    findings.front().alternatives.push_back(
        {"unknown", "vehicle", 0.5 * adequacy.as_likely->gain,
         "the same ways driven in another order (it may be " + adequacy.as_likely->where.regime + ")"});
  return findings;
}

std::optional<JointModel> beyond_doubt(const Named& names) {
  JointModel known = names.joint;
  known.accepted.clear();
  for (std::size_t k = 0; k < names.joint.accepted.size(); ++k)
    if (is_beyond_doubt(names.selected.evidence[k])) known.accepted.push_back(names.joint.accepted[k]);
  if (known.accepted.empty()) return std::nullopt;
  known.fit(2);
  return known;
}

std::vector<Finding> findings_beside_unnamed(const std::vector<Finding>& named, const Unnamed& more, const Named& names,
                                             JointModel without, const ReadyRecordings& ready, const Vehicle& nominal,
                                             double family_wise_error) {
  std::vector<Finding> findings;
  if (!more.is_of_the_clock) std::copy_if(named.begin(), named.end(), std::back_inserter(findings), is_known_clock);
  const Intervals of_it = refined(without, std::vector<double>(without.accepted.size(), 1.0));
  if (calibration_moved_the_mounting(ready.calibration, nominal))
    add_mounting(findings, without, of_it, ready.told(), nominal);
  add_clock(findings, without, of_it, ready.told(), nominal, ready.from_commands);
  Finding unknown = unknown_of(more, names);
  if (more.where.zone)
    for (const Finding& f : named)
      if (f.where.zone && overlap(*f.where.zone, *more.where.zone)) {
        unknown.where = f.where;
        unknown.where.regime = more.where.regime;
      }
  if (unknown.alternatives.empty()) add_nearest(unknown, names.selected.first_look, family_wise_error);
  leave_out_what_it_hardly_resembles(unknown);
  look_at_the_wheel(unknown);
  findings.insert(findings.begin(), std::move(unknown));
  return findings;
}

}  // namespace odolab
