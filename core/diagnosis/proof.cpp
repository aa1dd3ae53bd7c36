#include "core/diagnosis/proof.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/clocks_first.h"
#include "core/diagnosis/material.h"
#include "core/diagnosis/ready_run.h"
#include "core/odometry/prediction.h"

namespace odolab {

namespace {

using Eigen::VectorXd;

Vehicle vehicle_of(const JointModel& j, const Vehicle& nominal, int run) {
  Vehicle v = nominal;
  v.kind = j.model.drive;
  v.truth = j.model.truth;
  double mean = 0.0;
  for (double c : j.clock_s) mean += c / static_cast<double>(j.clock_s.size());
  v.truth.time_offset_s = run >= 0 ? j.clock_s[run] : mean;
  return v;
}

// Other runs under a model that is frozen but for their clocks.
JointModel frozen(const JointModel& source, std::vector<InnovationRun> runs, std::vector<char> commands,
                  const Diagnosis& d, const Vehicle& nominal, const FittedNoise& noise) {
  LeastSquaresCalibration start = d.calibration_alone;
  start.vehicle = vehicle_of(source, nominal, -1);
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
  align_clocks(j);
  j.linearise(false);
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

JointModel::GatheredError summed_up(const std::vector<JointModel>& models) {
  JointModel::GatheredError sum;
  for (const JointModel& m : models) sum.add(m.gathered_error());
  return sum;
}

// Of one model, or of several that hold a run each, and what they leave.
FitFigures figures(const std::vector<JointModel>& models, const JointModel::GatheredError& error) {
  double chi2 = 0.0, scalars = 0.0;
  for (const JointModel& j : models) chi2 += j.chi2(), scalars += j.scalars();
  return {std::sqrt(error.position_m2), std::sqrt(error.heading_rad2), scalars > 0.0 ? chi2 / scalars : 0.0};
}
FitFigures figures(const std::vector<JointModel>& models) { return figures(models, summed_up(models)); }

// What the noise alone leaves over the same windows; it is fitted too, and where chance was kind the floor is what was
// reached.
FitFigures noise_floor(const JointModel::GatheredError& error, const FitFigures& reached) {
  return {std::min(std::sqrt(error.noise_position_m2), reached.position_rms_m),
          std::min(std::sqrt(error.noise_heading_rad2), reached.heading_rms_rad),
          std::min(1.0, reached.normalised_chi2)};
}

struct ReadyRuns {
  std::vector<InnovationRun> runs;
  std::vector<char> commands;
};

ReadyRuns ready_runs(const std::vector<CheckedRecording>& checked, const Vehicle& nominal) {
  ReadyRuns ready;
  for (const CheckedRecording& c : checked) {
    Result<InnovationRun> run = ready_run(c, nominal);
    if (!run) continue;
    ready.runs.push_back(std::move(*run));
    ready.commands.push_back(c.from_commands);
  }
  return ready;
}

// Each run by a fit to the others.
std::vector<JointModel> left_out_in_turn(const JointModel& all) {
  std::vector<std::optional<JointModel>> of_run(all.runs().size());
  parallel_for(static_cast<int>(of_run.size()), [&](int r) { of_run[static_cast<std::size_t>(r)] = all.left_out(r); });
  std::vector<JointModel> models;
  for (std::optional<JointModel>& one : of_run) models.push_back(std::move(*one));
  return models;
}

JointModel with_noise(JointModel m, const FittedNoise& noise, bool with_columns) {
  m.model.noise = noise;
  m.linearise(with_columns);
  return m;
}

// The same term half a run later: as free as the finding, and without meaning.
Effect out_of_step(const Effect& of, const std::vector<double>& shape) {
  Effect placebo = of;
  placebo.scan = {};
  placebo.shapes.clear();
  placebo.shape_follows_amplitude = placebo.of_one_recording = placebo.and_later_recordings = placebo.clock_rate =
      false;
  for (Effect::Amplitude& a : placebo.amplitudes) a.low = -1e9, a.high = 1e9;
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

void prove(Diagnosis& d, const JointModel& joint, const JointModel& calibrated,
           const std::shared_ptr<const Effect>& spline, const std::vector<Recording>& train,
           const std::vector<CheckedRecording>& ready_held_out, const Vehicle& nominal) {
  const FittedNoise noise = joint.model.noise;
  const bool unnamed =
      std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.effect == "unknown"; });
  const JointModel& after = unnamed ? calibrated : joint;
  d.fitted_vehicle = vehicle_of(after, nominal, -1);
  for (std::size_t r = 0; r < train.size(); ++r) d.truth_clock_s.emplace_back(train[r].name, after.clock_s[r]);
  const auto with_term = [&](const Effect& term) {
    JointModel m = calibrated;
    m.accepted.push_back({&term, {}, std::vector<double>(term.amplitudes.size(), 0.0), {}});
    m.fit(2);
    return m;
  };
  const JointModel with_spline = with_term(*spline);
  Effect placebo;
  std::optional<JointModel> with_placebo;
  if (!after.accepted.empty() && !after.accepted[0].effect->clock_rate) {
    placebo = out_of_step(*after.accepted[0].effect, after.accepted[0].shape);
    with_placebo = with_term(placebo);
  }
  JointModel as_nominal = calibrated;
  as_nominal.model.drive = std::get<DifferentialDrive>(nominal.kind);
  as_nominal.model.truth = nominal.truth;
  const auto table = [&](const auto& judged) {
    FitTable t;
    t.nominal = figures(judged(as_nominal, true));
    t.calibrated = figures(judged(calibrated, false));
    const std::vector<JointModel> found = judged(after, false);
    const JointModel::GatheredError left = summed_up(found);
    t.with_findings = figures(found, left);
    t.spline = figures(judged(with_spline, false));
    if (with_placebo) t.placebo = figures(judged(*with_placebo, false));
    t.noise_floor = noise_floor(left, *t.with_findings);
    return t;
  };
  using Models = std::vector<JointModel>;
  d.train = table([&](const JointModel& m, bool) { return Models{with_noise(m, noise, false)}; });
  if (const ReadyRuns unseen = ready_runs(ready_held_out, nominal); !unseen.runs.empty()) {
    d.held_out = table(
        [&](const JointModel& m, bool) { return Models{frozen(m, unseen.runs, unseen.commands, d, nominal, noise)}; });
  } else if (ready_held_out.empty() && train.size() > 1) {
    d.left_out_in_turn = true;
    d.held_out = table([&](const JointModel& m, bool as_it_is) {
      const JointModel all = with_noise(m, noise, !as_it_is);
      return as_it_is ? Models{all} : left_out_in_turn(all);
    });
  }
}

std::optional<std::size_t> refuted(const JointModel& joint, const JointModel& calibrated, const Diagnosis& d,
                                   const std::vector<CheckedRecording>& ready_held_out, const Vehicle& nominal) {
  const FittedNoise noise = joint.model.noise;
  const ReadyRuns unseen = ready_runs(ready_held_out, nominal);
  if (joint.accepted.empty() || (unseen.runs.empty() && joint.runs().size() < 2)) return std::nullopt;
  const auto error_of = [&](const JointModel& m) {
    return unseen.runs.empty() ? summed_up(left_out_in_turn(with_noise(m, noise, true)))
                               : frozen(m, unseen.runs, unseen.commands, d, nominal, noise).gathered_error();
  };
  const JointModel::GatheredError with_all = error_of(joint);
  if (worse_than_chance(error_of(calibrated), with_all) <= 0.0) return std::nullopt;
  std::optional<std::size_t> worst;
  double most = 0.0;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    JointModel without = joint;
    without.accepted.erase(without.accepted.begin() + static_cast<std::ptrdiff_t>(k));
    without.fit(3);
    const double worse = worse_than_chance(error_of(without), with_all);
    if (worse > most) most = worse, worst = k;
  }
  return worst;
}

}  // namespace odolab
