#include "core/diagnosis/proof.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/diagnosis/model/as_many_samples.h"
#include "core/diagnosis/model/ready_run.h"
#include "core/diagnosis/naming/clocks_first.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/select.h"
#include "core/odometry/prediction.h"

namespace odolab {

namespace {

using Eigen::VectorXd;

Vehicle vehicle_of(const JointModel& j, const Vehicle& nominal) {
  Vehicle v = nominal;
  v.kind = j.model.drive;
  v.truth = j.model.truth;
  v.truth.time_offset_s = j.shared_clock().offset_s;
  return v;
}

// Clocks that were sought run by run, drawn to what other runs say of theirs the less a run tells of its own, unless it
// says beyond doubt that it has another: behind commands that are acted on unevenly eight corners of a square know a
// clock to 30 ms.
void draw_to_others(JointModel& j, const SharedClock& others) {
  constexpr double kLeastBetween_s = 0.005, kAnother = 9.0;  // of twice the log-likelihood: three standard errors
  const double between_s2 = std::pow(std::max(others.between_s, kLeastBetween_s), 2);
  for (std::size_t r = 0; r < j.runs().size(); ++r) {
    const int run = static_cast<int>(r);
    const double own_s = j.clock_s[r], by_own = j.minus_two_log_likelihood_of(run);
    j.clock_s[r] = others.offset_s;
    const double gained = std::max(0.0, j.minus_two_log_likelihood_of(run) - by_own), off_s = own_s - others.offset_s;
    // A gain of (off / standard error)^2 says how well it is known.
    const double share = gained > kAnother ? 1.0
                         : off_s != 0.0    ? between_s2 * gained / (between_s2 * gained + off_s * off_s)
                                           : 0.0;
    j.clock_s[r] = others.offset_s + share * off_s;
  }
}

// Other runs under a model that is frozen but for their clocks, or with these as well where it is as it was given: a
// vehicle that is wrong would drag them along.
JointModel frozen(const JointModel& source, std::vector<InnovationRun> runs, std::vector<char> commands,
                  LeastSquaresCalibration start, const Vehicle& nominal, const FittedNoise& noise,
                  Predictor::Fit fit = Predictor::Fit::to_recordings) {
  start.vehicle = vehicle_of(source, nominal);
  start.noise = noise;
  start.time_offset_s.assign(runs.size(), start.vehicle.truth.time_offset_s);
  JointModel j(std::move(runs), std::move(commands), start, nominal);
  for (AcceptedEffect a : source.accepted) {
    if (a.effect->of_one_recording) continue;
    if (a.effect->of_each_recording && !a.effect->clock_rate) continue;  // phases of their own are not known of others
    if (a.effect->clock_rate && a.effect->of_each_recording) {
      a.effect = &effects::clock_rate_of_each_run(static_cast<int>(j.runs().size())).front();
      a.value.assign(j.runs().size(), 0.0);
    }
    j.accepted.push_back(a);
  }
  j.linearise(false);
  j.gate();
  if (fit != Predictor::Fit::none) {
    // Commands that are acted on sooner or later excuse what happens at each change, and what is left then pulls the
    // clock by tens of milliseconds: as if all were acted on alike, it is their mean.
    const double command_timing_s = std::exchange(j.model.noise.command_timing_s, 0.0);
    align_clocks(j);
    j.model.noise.command_timing_s = command_timing_s;
    draw_to_others(j, source.shared_clock());
    j.linearise(false);
  }
  // Whether what came in one recording and stayed is there in these is not known either.
  for (std::size_t k = 0; k < j.accepted.size(); ++k) {
    if (!j.accepted[k].effect->and_later_recordings) continue;
    JointModel there = j;
    there.accepted[k].shape[0] = -1.0;
    there.linearise(false);
    if (there.minus_two_log_likelihood() < j.minus_two_log_likelihood()) j = std::move(there);
  }
  return j;
}

// Of one model, or of several that hold a run each.
Predicted::Side side_of(const std::vector<JointModel>& models) {
  Predicted::Side side;
  double chi2 = 0.0, scalars = 0.0;
  for (const JointModel& j : models) {
    side.of_model.push_back(j.gathered_error());
    side.minus_two_log_likelihood.push_back(j.minus_two_log_likelihood());
    side.scalars.push_back(j.scalars());
    side.error.add(side.of_model.back());
    chi2 += j.chi2(), scalars += j.scalars();
  }
  if (side.error.windows == 0)
    for (const JointModel& j : models) side.of_path.add(j.path_error());
  const JointModel::GatheredError& shown = side.shown();
  side.figures = {std::sqrt(shown.position_m2), std::sqrt(shown.heading_rad2), scalars > 0.0 ? chi2 / scalars : 0.0};
  return side;
}

// What the noise alone leaves over the same windows; it is fitted too, and where chance was kind the floor is what was
// reached.
FitFigures noise_floor(const Predicted::Side& reached) {
  const JointModel::GatheredError& shown = reached.shown();
  return {std::min(std::sqrt(shown.noise_position_m2), reached.figures.position_rms_m),
          std::min(std::sqrt(shown.noise_heading_rad2), reached.figures.heading_rms_rad),
          std::min(1.0, reached.figures.normalised_chi2)};
}

// Each run by a fit to the others.
std::vector<JointModel> left_out_in_turn(const JointModel& all) {
  std::vector<std::optional<JointModel>> of_run(all.runs().size());
  parallel_for(static_cast<int>(of_run.size()), [&](int r) { of_run[static_cast<std::size_t>(r)] = all.left_out(r); });
  std::vector<JointModel> models;
  for (std::optional<JointModel>& one : of_run) models.push_back(std::move(*one));
  return models;
}

// The same term half a run later: as free as the finding, and without meaning.
Effect out_of_step(const Effect& of, const std::vector<double>& shape) {
  Effect placebo = of;
  placebo.scan = {};
  placebo.shapes.clear();
  placebo.shape_follows_amplitude = placebo.of_one_recording = placebo.and_later_recordings = placebo.clock_rate =
      false;
  for (Effect::Amplitude& a : placebo.amplitudes) a.low = -kUnbounded, a.high = kUnbounded;
  const auto motions = of.motions;
  placebo.motions = [motions, shape](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> m = motions(view, shape);
    const std::size_t n = view.steps.size();
    for (Motions& one : m) {
      Motions later(n);
      for (std::size_t i = 0; i < n; ++i) later[i] = one.at((i + n / 2) % n);
      one = later;
    }
    return m;
  };
  return placebo;
}

}  // namespace

bool Predicted::tells(std::size_t model, const Predicted& other) const {
  return is_foretold.empty() || is_foretold.size() != other.is_foretold.size() || is_foretold[model];
}

Predictor::Predictor(const std::vector<CheckedRecording>& ready_held_out, const LeastSquaresCalibration& calibration,
                     const Vehicle& nominal, const std::vector<AlignedClock>& clocks)
    : calibration_(calibration), nominal_(nominal) {
  std::vector<Result<InnovationRun>> runs = condensed_runs(ready_held_out, nominal, calibration, false, clocks);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r]) continue;
    runs_.push_back(*std::move(runs[r]));
    commands_.push_back(ready_held_out[r].from_commands);
  }
}

Predicted Predictor::of(const JointModel& model, const FittedNoise& noise, Fit fit) const {
  const bool leaves_out_in_turn = runs_.empty() && model.runs().size() > 1 && fit == Fit::to_recordings;
  std::vector<JointModel> all = {model.under(noise)};
  all[0].linearise(leaves_out_in_turn);
  Predicted p;
  p.fitted = side_of(all);
  if (!runs_.empty())
    p.unseen = side_of({frozen(model, runs_, commands_, calibration_, nominal_, noise, fit)});
  else if (leaves_out_in_turn) {
    const std::vector<JointModel> each = left_out_in_turn(all[0]);
    p.unseen = side_of(each);
    for (const JointModel& one : each) p.is_foretold.push_back(one.is_foretold);
  } else if (model.runs().size() > 1)
    p.unseen = p.fitted;
  return p;
}

std::optional<JointModel> Predictor::fitted_to_all(const JointModel& model) const {
  if (runs_.empty()) return std::nullopt;
  for (const AcceptedEffect& a : model.accepted)
    if (a.effect->and_later_recordings || (a.effect->of_each_recording && a.acts_on_motion())) return std::nullopt;
  JointModel all = model.together_with(frozen(model, runs_, commands_, calibration_, nominal_, model.model.noise));
  all.fit(2);
  return all;
}

void prove(Diagnosis& d, const Predictor& predictor, const Compared& compared,
           const std::shared_ptr<const Effect>& spline, const std::vector<Recording>& train) {
  const FittedNoise& noise = compared.noise;
  const JointModel &after = compared.said, &calibrated = compared.calibrated;
  const Predicted &by_after = compared.by_said, &by_calibrated = compared.by_calibrated;
  d.fitted_vehicle = vehicle_of(after, predictor.nominal());
  for (std::size_t r = 0; r < train.size(); ++r) d.truth_clock_s.emplace_back(train[r].name, after.clock_s[r]);
  const auto by_term = [&](const Effect& term) {
    JointModel m = calibrated;
    m.accepted.push_back({&term, {}, std::vector<double>(term.amplitudes.size(), 0.0)});
    m.fit(2);
    return predictor.of(m, noise);
  };
  const Predicted by_spline = by_term(*spline);
  std::optional<Predicted> by_placebo;
  if (!after.accepted.empty() && after.accepted[0].acts_on_motion())
    by_placebo = by_term(out_of_step(*after.accepted[0].effect, after.accepted[0].shape));
  JointModel as_nominal = calibrated;
  as_nominal.model.drive = std::get<DifferentialDrive>(predictor.nominal().kind);
  as_nominal.model.truth = predictor.nominal().truth;
  const Predicted by_nominal = predictor.of(as_nominal, noise, Predictor::Fit::none);
  const auto table = [&](const auto& side) {
    FitTable t;
    t.nominal = side(by_nominal).figures;
    t.calibrated = side(by_calibrated).figures;
    t.with_findings = side(by_after).figures;
    t.spline = side(by_spline).figures;
    if (by_placebo) t.placebo = side(*by_placebo).figures;
    t.noise_floor = noise_floor(side(by_after));
    return t;
  };
  d.train = table([](const Predicted& p) { return p.fitted; });
  d.left_out_in_turn = predictor.leaves_out_in_turn() && by_after.unseen;
  if (by_after.unseen) d.held_out = table([](const Predicted& p) { return *p.unseen; });
  bool any_tells = false;
  for (std::size_t m = 0; by_after.unseen && m < by_after.unseen->of_model.size(); ++m)
    any_tells = any_tells || by_after.tells(m, by_calibrated);
  if (any_tells && by_calibrated.unseen && !after.accepted.empty())
    d.unseen_gain = 0.5 * likelier_where_unseen(by_after, by_calibrated);
}

double likelier_where_unseen(const Predicted& one, const Predicted& other) {
  double gained = 0.0;
  for (std::size_t m = 0; m < one.unseen->minus_two_log_likelihood.size(); ++m) {
    if (!one.tells(m, other)) continue;
    const auto of = [m](const auto& unseen) {
      return MisfitOfSamples{unseen->minus_two_log_likelihood[m], unseen->scalars[m]};
    };
    gained += likelier_by(of(one.unseen), of(other.unseen));
  }
  return gained;
}

// What comes and goes within centimetres moves no window of a metre, but thousands of samples deny it together. A right
// name whose form is not quite the world's made unseen runs less likely by 23 at most (of 222 sets of two programs).
constexpr double kNeverByItsForm = 100.0;  // twice the log-likelihood

Denied denied_where_unseen(const Predicted& one, const Predicted& other, bool is_white) {
  const double likelier = likelier_where_unseen(one, other);
  if (is_white && likelier > kClearlyBeaten) return {};
  if (likelier < -kNeverByItsForm) return {.by_likelihood = -likelier};
  JointModel::GatheredError was, is;
  for (std::size_t m = 0; m < one.unseen->of_model.size(); ++m) {
    if (!one.tells(m, other)) continue;
    was.add(other.unseen->of_model[m]);
    is.add(one.unseen->of_model[m]);
  }
  return {.by_dead_reckoning = worse_than_chance(was, is)};
}

std::optional<std::size_t> refuted(const Predictor& predictor, const JointModel& joint, const Predicted& by_joint,
                                   const Predicted& by_calibrated) {
  if (joint.accepted.empty() || !by_joint.unseen) return std::nullopt;
  const bool is_white = joint.distrust() == 0.0;
  if (denied_where_unseen(by_joint, by_calibrated, is_white) <= Denied{}) return std::nullopt;
  std::optional<std::size_t> worst;
  Denied most;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    JointModel without = joint;
    without.accepted.erase(without.accepted.begin() + static_cast<std::ptrdiff_t>(k));
    without.fit(3);
    // What shows at rest is no doing of correlated innovations.
    const Denied denied = denied_where_unseen(by_joint, predictor.of(without, joint.model.noise),
                                              is_white || joint.shows_at_rest(*joint.accepted[k].effect));
    if (denied > most) most = denied, worst = k;
  }
  return worst;
}

}  // namespace odolab
