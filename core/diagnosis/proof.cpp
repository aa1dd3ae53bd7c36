#include "core/diagnosis/proof.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/prediction.h"

namespace odolab {

namespace {

using Eigen::VectorXd;

struct Gathered {
  double position = 0.0, heading = 0.0;
  int windows = 0;
};

void gather(Gathered& g, const Recording& recording, const Vehicle& vehicle, const std::vector<ActiveEffect>& effects) {
  const Result<Track> track = predicted_track(recording, vehicle, effects);
  if (!track) return;
  const std::optional<TrackError> e = track_error(*track, truth_track(recording));
  if (!e || e->windows == 0) return;
  g.position += e->windows * e->position_rms_m * e->position_rms_m;
  g.heading += e->windows * e->heading_rms_rad * e->heading_rms_rad;
  g.windows += e->windows;
}

FitFigures figures(const Gathered& g, double chi2) {
  FitFigures f;
  f.position_rms_m = g.windows > 0 ? std::sqrt(g.position / g.windows) : 0.0;
  f.heading_rms_rad = g.windows > 0 ? std::sqrt(g.heading / g.windows) : 0.0;
  f.normalised_chi2 = chi2;
  return f;
}

Vehicle vehicle_of(const JointModel& j, const Vehicle& nominal, int run) {
  Vehicle v = nominal;
  v.kind = j.model.drive;
  v.truth = j.model.truth;
  double mean = 0.0;
  for (double c : j.clock_s) mean += c / static_cast<double>(j.clock_s.size());
  v.truth.time_offset_s = run >= 0 ? j.clock_s[run] : mean;
  return v;
}

// The findings as far as they act in a recording: events belong to one.
std::vector<ActiveEffect> effects_in(const Diagnosis& d, const JointModel& j, const std::string& recording, bool same) {
  std::vector<ActiveEffect> out;
  for (const AcceptedEffect& a : j.accepted) {
    if (a.effect->of_one_recording && (!same || j.runs()[static_cast<std::size_t>(a.shape[0])].name != recording)) continue;
    for (const Finding& f : d.findings)
      if (f.effect == a.effect->name && f.component == a.effect->component) {
        ActiveEffect e = f.as_active();
        if (a.effect->shape_follows_amplitude || e.parameters.size() > 0) out.push_back(e);
        break;
      }
  }
  return out;
}

// Chi-square per innovation of other runs under a model that is frozen but for their clocks.
JointModel frozen(const JointModel& source, std::vector<InnovationRun> runs, std::vector<char> commands,
                   const Diagnosis& d, const Vehicle& nominal, const FittedNoise& noise) {
  LeastSquaresCalibration start = d.calibration_alone;
  start.vehicle = vehicle_of(source, nominal, -1);
  start.noise = noise;
  start.time_offset_s.assign(runs.size(), start.vehicle.truth.time_offset_s);
  JointModel j(std::move(runs), std::move(commands), start, nominal);
  for (const AcceptedEffect& a : source.accepted)
    if (!a.effect->of_one_recording) j.accepted.push_back(a);
  j.linearise();
  j.gate();
  j.linearise();
  return j;
}

double share(const JointModel& j) { return j.scalars() > 0 ? j.chi2() / j.scalars() : 0.0; }

FitFigures figures(const JointModel& j) {
  const JointModel::GatheredError e = j.gathered_error();
  return {std::sqrt(e.position_m2), std::sqrt(e.heading_rad2), share(j)};
}

// The same term half a run later: as free as the finding, and without meaning.
Effect out_of_step(const Effect& of, const std::vector<double>& shape) {
  Effect placebo = of;
  placebo.scan = {};
  placebo.shapes.clear();
  placebo.shape_follows_amplitude = placebo.of_one_recording = placebo.clock_rate = false;
  for (Effect::Amplitude& a : placebo.amplitudes) a.low = -1e9, a.high = 1e9;
  const auto motions = of.motions;
  placebo.motions = [motions, shape](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> m = motions(view, shape);
    for (Motions& one : m) std::rotate(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(one.size() / 2), one.end());
    return m;
  };
  return placebo;
}

}  // namespace

void prove(Diagnosis& d, const JointModel& joint, const JointModel& calibrated,
           const std::shared_ptr<const Effect>& spline, const std::vector<Recording>& train,
           const std::vector<Recording>& held_out, const std::vector<CheckedRecording>& ready_held_out,
           const Vehicle& nominal) {
  const FittedNoise noise = joint.model.noise;
  const bool unnamed = std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.effect == "unknown"; });
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
  const auto table = [&](const std::vector<Recording>& recordings, bool same) {
    FitTable t;
    Gathered g_nominal, g_calibrated, g_found;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      const int run = same ? static_cast<int>(r) : -1;
      gather(g_nominal, recordings[r], nominal, {});
      gather(g_calibrated, recordings[r], vehicle_of(calibrated, nominal, run), {});
      gather(g_found, recordings[r], vehicle_of(after, nominal, run), effects_in(d, after, recordings[r].name, same));
    }
    std::vector<InnovationRun> runs;
    std::vector<char> commands;
    if (same) {
      runs = joint.runs();
      for (const DriveView& v : joint.views()) commands.push_back(v.from_commands);
    } else {
      for (const CheckedRecording& c : ready_held_out) {
        Result<InnovationRun> run = innovation_run(c.recording, nominal);
        if (!run) continue;
        runs.push_back(std::move(*run));
        commands.push_back(c.from_commands);
      }
    }
    if (runs.empty()) return t;
    const auto judged = [&](const JointModel& m) {
      if (same) {
        JointModel copy = m;
        copy.model.noise = noise;
        copy.linearise();
        return copy;
      }
      return frozen(m, runs, commands, d, nominal, noise);
    };
    JointModel as_nominal = calibrated;
    as_nominal.model.drive = std::get<DifferentialDrive>(nominal.kind);
    as_nominal.model.truth = nominal.truth;
    t.nominal = figures(g_nominal, share(judged(as_nominal)));
    t.calibrated = figures(g_calibrated, share(judged(calibrated)));
    t.with_findings = figures(g_found, share(judged(after)));
    // The scales of commands are no part of a vehicle's file: there the model itself is asked.
    if (std::find(commands.begin(), commands.end(), 1) != commands.end()) {
      t.calibrated = figures(judged(calibrated));
      t.with_findings = figures(judged(after));
    }
    t.spline = figures(judged(with_spline));
    if (with_placebo) t.placebo = figures(judged(*with_placebo));
    // What noise alone leaves over a metre: truth at both ends, its heading at the start, and the wheels.
    const double q2 = noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m, b = joint.model.drive.wheelbase_m;
    const double p2 = noise.truth_position_m * noise.truth_position_m, h2 = noise.truth_heading_rad * noise.truth_heading_rad;
    FitFigures floor;
    floor.position_rms_m = std::sqrt(4.0 * p2 + h2 + 0.5 * q2 + 2.0 * q2 / (3.0 * b * b));
    floor.heading_rms_rad = std::sqrt(2.0 * h2 + 2.0 * q2 / (b * b));
    floor.normalised_chi2 = 1.0;
    t.noise_floor = floor;
    return t;
  };
  d.train = table(train, true);
  if (!held_out.empty()) d.held_out = table(held_out, false);
}

}  // namespace odolab
