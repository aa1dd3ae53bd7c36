// The track that a vehicle with effects switched on predicts from its encoders alone.
#include "core/odometry/prediction.h"

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/effect.h"
#include "core/diagnosis/quality.h"

namespace odolab {

Result<Track> predicted_track(const Recording& recording, const Vehicle& vehicle,
                              const std::vector<ActiveEffect>& effects) {
  if (effects.empty()) return predicted_track(recording, vehicle);
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  if (const auto other = other_than_differential_drive(vehicle, "can have effects fitted to it")) return *other;
  const CheckedRecording ready = checked(recording, vehicle);
  const bool from_commands = ready.from_commands;
  Vehicle with = vehicle;
  double rate = 0.0, delay_s = 0.0;
  for (const ActiveEffect& a : effects) {
    if (a.effect == "clock_rate") rate += a.parameter("rate");
    if (a.effect == "actuator_delay") delay_s += a.parameter("delay_s");
    if (a.effect == "truth_time_offset") with.truth.time_offset_s = a.parameter("offset_s");
    if (a.effect == "truth_mounting_offset")
      with.truth.axle_T_tracked = {a.parameter("x_m"), a.parameter("y_m"), a.parameter("heading_rad")};
  }
  InnovationRun run;
  run.wheels = wheel_samples(ready.recording, *drive);
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (run.wheels.size() < 2) return predicted_track(recording, vehicle);
  const double t0 = run.wheels.front().time_s;
  for (WheelSample& w : run.wheels) w.time_s = t0 + (w.time_s - t0) / (1.0 + rate) + delay_s;
  const Pose mounting = with.truth.axle_T_tracked;
  Pose start;
  double start_s = run.wheels.front().time_s;
  if (!truth.empty()) {
    start = Pose{truth[0].position.x_m, truth[0].position.y_m, truth[0].heading_rad.value_or(0.0)} * inverse(mounting);
    start_s = truth[0].time_s - with.truth.time_offset_s;
    run.truth = {truth[0]};
  } else {
    run.truth = {TruthSample{start_s, {}, 0.0}};
  }

  // Effects of a place act where the track is, and the track is where they put it: twice is enough.
  Track track;
  for (int pass = 0; pass < 2; ++pass) {
    const DriveView view = drive_view(0, run, *drive, from_commands, track);
    Motions sum(view.steps.size());
    for (const ActiveEffect& a : effects) {
      const Effect* e = catalogue_entry(a);
      if (!e || e->clock_rate || (e->only_commands && !from_commands)) continue;
      std::vector<double> value, shape;
      if (e->from_parameters)
        value = e->from_parameters(a);
      else
        for (const Effect::Amplitude& p : e->amplitudes) value.push_back(a.parameter(p.name));
      for (const Effect::Amplitude& p : e->shapes) shape.push_back(p.name == "recording" ? 0.0 : a.parameter(p.name));
      if (e->forms.size() > 1) shape.push_back(a.parameter("form"));
      const std::vector<Motions> motions = e->motions(view, shape);
      for (std::size_t k = 0; k < motions.size(); ++k)
        for (std::size_t i = 0; i < motions[k].size(); ++i) {
          sum[i].forward_m += value[k] * motions[k][i].forward_m;
          sum[i].sideways_m += value[k] * motions[k][i].sideways_m;
          sum[i].turn_rad += value[k] * motions[k][i].turn_rad;
        }
    }
    track.clear();
    Pose pose;
    track.push_back({run.wheels[0].time_s, pose});
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double turn = s.turn_rad + sum[i].turn_rad, middle = pose.heading_rad + 0.5 * turn;
      const double f = s.forward_m() + sum[i].forward_m, l = sum[i].sideways_m;
      pose = {pose.x_m + f * std::cos(middle) - l * std::sin(middle),
              pose.y_m + f * std::sin(middle) + l * std::cos(middle), pose.heading_rad + turn};
      track.push_back({run.wheels[i + 1].time_s, pose});
    }
    const double at_s = std::min(std::max(start_s, track.front().time_s), track.back().time_s);
    const Pose there = *pose_at(track, at_s);
    for (TimedPose& p : track) p.pose = start * between(there, p.pose);
  }
  for (TimedPose& p : track) p = {p.time_s + with.truth.time_offset_s, p.pose * mounting};
  return track;
}

}  // namespace odolab
