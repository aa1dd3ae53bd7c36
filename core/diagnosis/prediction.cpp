// The track that a vehicle with effects switched on predicts from its encoders alone.
#include "core/odometry/prediction.h"

#include <cmath>
#include <utility>

#include "core/calibration/restamped.h"
#include "core/calibration/smoothed_readings.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/quality/quality.h"
#include "core/diagnosis/units/prediction.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/geometry/small_turn.h"

namespace odolab {

namespace {

// Of a track with a pose for each reading of wheels that obey commands, those that have a command.
Track at_commands(const Track& track, const Recording& obeying) {
  const Channel &left = *obeying.channel("left_wheel_rad"), &speed = *obeying.channel("command_speed_mps");
  Track kept;
  std::size_t reading = 0;
  for (std::size_t row = 0; row < obeying.time_s.size(); ++row) {
    if (std::isnan(left.values[row])) continue;
    if (!std::isnan(speed.values[row])) kept.push_back(track[reading]);
    ++reading;
  }
  return kept;
}

// A pose for each reading, though a row that stands there twice was read once.
Track for_each_reading(Track once, const std::vector<WheelSample>& readings) {
  Track all;
  std::size_t read = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const bool again = i > 0 && readings[i].time_s == readings[i - 1].time_s &&
                       readings[i].left_rad == readings[i - 1].left_rad &&
                       readings[i].right_rad == readings[i - 1].right_rad;
    if (!again && read++ == once.size()) return once;
    all.push_back(once[read - 1]);
  }
  return read == once.size() ? all : once;
}

}  // namespace

Result<Track> predicted_track(const Recording& recording, const Vehicle& vehicle,
                              const std::vector<ActiveEffect>& effects) {
  if (effects.empty()) return predicted_track(recording, vehicle);
  if (has_units(vehicle)) return predicted_track_of_units(recording, vehicle, effects);
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  if (const auto other = other_than_differential_drive(vehicle, "can have effects fitted to it")) return *other;
  const CheckedRecording ready = checked(recording, vehicle);
  const bool from_commands = ready.from_commands;
  const TruthMounting mounting = truth_under(effects, vehicle.truth);
  double rate = 0.0, delay_s = 0.0;
  for (const ActiveEffect& a : effects) {
    if (a.effect == "clock_rate") rate += a.parameter("rate");
    if (a.effect == "actuator_delay") delay_s += a.parameter("delay_s");
  }
  InnovationRun run;
  run.wheels = wheel_samples(ready.recording, *drive);
  if (run.wheels.size() < 2) return predicted_track(recording, vehicle);
  const TimedPose start = predicted_start(recording, mounting, run.wheels.front().time_s);
  run.truth = {TruthSample{start.time_s, start.pose.position(), start.pose.heading_rad}};
  put_clock_right(run, rate, 0.0);
  put_later(run, delay_s);
  if (!from_commands) run.smooth = smoothed(run.wheels);

  Track track = settled([&](const Track& before) {
    const DriveView view = drive_view(0, run, *drive, from_commands, before);
    const std::vector<BodyMotion> sum = motions_of(view, effects);
    Track axle;
    Pose pose;
    axle.push_back({run.wheels[0].time_s, pose});
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double turn = s.turn_rad + sum[i].turn_rad, middle = pose.heading_rad + 0.5 * turn;
      const double chord = chord_share(turn), f = chord * (s.forward_m() + sum[i].forward_m),
                   l = chord * sum[i].sideways_m;
      pose = {pose.x_m + f * std::cos(middle) - l * std::sin(middle),
              pose.y_m + f * std::sin(middle) + l * std::cos(middle), pose.heading_rad + turn};
      axle.push_back({run.wheels[i + 1].time_s, pose});
    }
    return through(std::move(axle), start);
  });
  track = as_tracked(std::move(track), mounting);
  return within_bounds(from_commands ? at_commands(track, ready.recording)
                                     : for_each_reading(std::move(track), wheel_samples(recording, *drive)),
                       recording);
}

}  // namespace odolab
