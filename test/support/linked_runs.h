// Recordings of linked and castor vehicles from exact kinematics, with wheels that scrub at random, encoders that
// round, and a noisy truth; what is wrong with a wheel is put on what it counts.
#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include "core/base/random.h"
#include "core/kinematics/castors.h"
#include "core/kinematics/trucks.h"
#include "core/recording/vehicle_samples.h"

namespace odolab::test {

// What a wheel counts too much in a step, from its rotation so far and what it turns now.
using Miscount = std::function<double(double time_s, double rotation_rad, double by_rad)>;

inline Vehicle vehicle_of(const VehicleKind& kind) {
  Vehicle v;
  v.kind = kind;
  return v;
}

// Two trucks whose link is read to half a milliradian and a tenth of a millimetre.
inline Clapper fine_clapper() {
  Clapper trucks;
  trucks.link_angle_resolution_rad = 0.0005;
  trucks.link_length_resolution_m = 0.0001;
  return trucks;
}

// All of it, wheels and axles.
inline Clapper larger(Clapper trucks, double share) {
  for (DifferentialDrive* d : {&trucks.truck_a, &trucks.truck_b})
    for (double* length : {&d->wheel_radius_left_m, &d->wheel_radius_right_m, &d->wheelbase_m}) *length *= 1.0 + share;
  return trucks;
}

struct LinkedRunSettings {
  double duration_s = 30.0;
  double step_s = 0.01;
  int steps_per_sample = 4;
  double wheel_noise = 3e-4;  // m per root metre
  double truth_m = 0.001, truth_rad = 0.002;
  Miscount b_left;  // truck B's left wheel, or the trailer's; may be empty
};

// Random scrub of one wheel and what it counts wrong.
inline double extra_rad(double by_rad, double radius_m, double noise, const Miscount& wrong, double time_s,
                        double& rotation_rad, Random& random) {
  double extra = noise / radius_m * std::sqrt(std::abs(by_rad) * radius_m) * random.normal();
  if (wrong) extra += wrong(time_s, rotation_rad, by_rad);
  rotation_rad += by_rad;
  return extra;
}

inline void add_truth(Recording& recording, const Track& truth, const LinkedRunSettings& s, Random& random) {
  for (const char* name : {"truth_x_m", "truth_y_m", "truth_heading_rad"}) recording.add_channel(name);
  const std::size_t n = recording.channels.size();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    recording.channels[n - 3].values[i] = truth[i].pose.x_m + s.truth_m * random.normal();
    recording.channels[n - 2].values[i] = truth[i].pose.y_m + s.truth_m * random.normal();
    recording.channels[n - 1].values[i] = truth[i].pose.heading_rad + s.truth_rad * random.normal();
  }
}

// Truck A wanders with turns and stops; B follows the link, swinging from side to side behind it.
inline Recording linked_run(const LinkedTrucks& actual, const LinkedRunSettings& s, std::uint64_t seed) {
  Random random(seed);
  const double phase = random.uniform(0.0, 6.0);
  LinkedKinematics machine(actual, {}, 0.0, 0.0, actual.link_length_m);
  std::vector<LinkedSample> samples;
  Track truth;
  double speed_b = 0.0, rate_b = 0.0, turned[4] = {};
  const int steps = static_cast<int>(s.duration_s / s.step_s);
  for (int i = 0; i <= steps; ++i) {
    const double t = i * s.step_s;
    if (i % s.steps_per_sample == 0) {
      samples.push_back(rounded(machine.reading(), actual, seed));
      truth.push_back({t, machine.a()});
    }
    const double ease = std::min(1.0, t);
    const TruckTwist a{ease * (0.2 + 0.2 * std::sin(0.6 * t + phase)), ease * 0.5 * std::sin(0.37 * t + 2.0 * phase)};
    const double alpha = machine.a().heading_rad - machine.link_heading_rad();
    const double beta = wrapped(machine.b().heading_rad - machine.link_heading_rad());
    const double want = 0.3 * std::sin(0.5 * t);
    const double want_speed = a.speed_mps * std::cos(alpha) + 0.8 * (machine.link_length_m() - actual.link_length_m);
    const double link_rate = (a.speed_mps * std::sin(alpha) - speed_b * std::sin(beta)) / machine.link_length_m();
    speed_b += std::clamp(want_speed - speed_b, -0.5 * s.step_s, 0.5 * s.step_s);
    rate_b += std::clamp(link_rate - 1.5 * (beta - want) - rate_b, -2.0 * s.step_s, 2.0 * s.step_s);
    const TruckTwist b{speed_b, rate_b};
    const WheelRotation by_a = wheel_rotation(actual.truck_a, a.speed_mps * s.step_s, a.yaw_rate_radps * s.step_s);
    const WheelRotation by_b = wheel_rotation(actual.truck_b, b.speed_mps * s.step_s, b.yaw_rate_radps * s.step_s);
    machine.move(a, b, s.step_s);
    const DifferentialDrive &da = actual.truck_a, &db = actual.truck_b;
    WheelRotation idle_a, idle_b;
    idle_a.left_rad = extra_rad(by_a.left_rad, da.wheel_radius_left_m, s.wheel_noise, {}, t, turned[0], random);
    idle_a.right_rad = extra_rad(by_a.right_rad, da.wheel_radius_right_m, s.wheel_noise, {}, t, turned[1], random);
    idle_b.left_rad = extra_rad(by_b.left_rad, db.wheel_radius_left_m, s.wheel_noise, s.b_left, t, turned[2], random);
    idle_b.right_rad = extra_rad(by_b.right_rad, db.wheel_radius_right_m, s.wheel_noise, {}, t, turned[3], random);
    machine.add_idle_rotation(idle_a, idle_b);
  }
  Recording recording = recording_of(samples);
  recording.name = "run_" + std::to_string(seed);
  add_truth(recording, truth, s, random);
  return recording;
}

// A vehicle that tows a trailer forwards, with turns.
inline Recording trailer_run(const EncoderTrailer& actual, const LinkedRunSettings& s, std::uint64_t seed) {
  Random random(seed);
  const double phase = random.uniform(0.0, 6.0);
  TrailerKinematics machine(actual, {}, 0.0);
  std::vector<TrailerSample> samples;
  Track truth;
  double turned[2] = {};
  const int steps = static_cast<int>(s.duration_s / s.step_s);
  for (int i = 0; i <= steps; ++i) {
    const double t = i * s.step_s;
    if (i % s.steps_per_sample == 0) {
      samples.push_back(rounded(machine.reading(), actual, seed));
      truth.push_back({t, machine.tow()});
    }
    const double ease = std::min(1.0, t);
    const TrailerSample before = machine.reading();
    machine.move({ease * (0.3 + 0.15 * std::sin(0.6 * t + phase)), ease * 0.6 * std::sin(0.43 * t + phase)}, s.step_s);
    const TrailerSample now = machine.reading();
    WheelRotation idle;
    idle.left_rad = extra_rad(now.trailer.left_rad - before.trailer.left_rad, actual.trailer.wheel_radius_left_m,
                              s.wheel_noise, s.b_left, t, turned[0], random);
    idle.right_rad = extra_rad(now.trailer.right_rad - before.trailer.right_rad, actual.trailer.wheel_radius_right_m,
                               s.wheel_noise, {}, t, turned[1], random);
    machine.add_idle_rotation({}, idle);
  }
  Recording recording = recording_of(samples);
  recording.name = "run_" + std::to_string(seed);
  add_truth(recording, truth, s, random);
  return recording;
}

// A platform that goes about, sideways too.
inline Recording castor_run(const MultiCastor& actual, const LinkedRunSettings& s, std::uint64_t seed) {
  Random random(seed);
  const double phase = random.uniform(0.0, 6.0);
  CastorKinematics machine(actual, {}, trailing_angles(actual, {0.3, 0.0, 0.0, 1.0}));
  std::vector<CastorSample> samples;
  Track truth;
  std::vector<double> turned(2 * actual.castors.size(), 0.0);
  const int steps = static_cast<int>(s.duration_s / s.step_s);
  for (int i = 0; i <= steps; ++i) {
    const double t = i * s.step_s;
    if (i % s.steps_per_sample == 0) {
      samples.push_back(rounded(machine.reading(), actual, seed));
      truth.push_back({t, machine.body()});
    }
    const double ease = std::min(1.0, t);
    const CastorSample before = machine.reading();
    machine.move(
        {ease * 0.3, ease * 0.15 * std::sin(0.5 * t + phase), ease * 0.5 * std::sin(0.31 * t + phase), s.step_s});
    const CastorSample now = machine.reading();
    for (std::size_t k = 0; k < actual.castors.size(); ++k) {
      const Castor& c = actual.castors[k];
      const WheelRotation &w = now.castors[k].wheels, &v = before.castors[k].wheels;
      const double left = extra_rad(w.left_rad - v.left_rad, c.wheel_radius_left_m, s.wheel_noise,
                                    k == 1 ? s.b_left : Miscount{}, t, turned[2 * k], random);
      const double right =
          extra_rad(w.right_rad - v.right_rad, c.wheel_radius_right_m, s.wheel_noise, {}, t, turned[2 * k + 1], random);
      machine.add_idle_rotation(k, left, right);
    }
  }
  Recording recording = recording_of(samples);
  recording.name = "run_" + std::to_string(seed);
  add_truth(recording, truth, s, random);
  return recording;
}

}  // namespace odolab::test
