// A differential drive on paper: smooth wheel speeds, exact arcs in steps of half a millisecond, slip that is injected
// in each of them, encoders that count whole counts, and a truth on its own clock and mounting. It shares no formula
// with the filter.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab::test {

struct WheelSpeedsAt {
  double left_radps = 0.0;
  double right_radps = 0.0;
};
using SpeedProfile = std::function<WheelSpeedsAt(double time_s)>;

// One step of the drive, open to be altered: what the wheels roll on the floor and what is added to it.
struct InjectedStep {
  double time_s = 0.0, dt_s = 0.0;
  Pose pose;                                   // at its start
  double left_rad = 0.0, right_rad = 0.0;      // true rotation at its start
  double left_radps = 0.0, right_radps = 0.0;  // as the encoders turn
  double left_m = 0.0, right_m = 0.0;          // rolled on the floor
  double left_read_rad = 0.0, right_read_rad = 0.0;  // what the encoders make of the rotation
  double sideways_m = 0.0, turn_rad = 0.0;     // added to the body's motion
  Vec2 room_m;                                 // added in the room
};

struct GeneratorSettings {
  DifferentialDrive drive;  // the true one
  TruthMounting truth;      // the true one
  double duration_s = 30.0;
  double step_s = 0.0005;
  double wheel_period_s = 0.02;
  double truth_period_s = 0.05;  // 0: only at the start and at the end
  double truth_phase_s = 0.0033;
  bool truth_has_heading = true;
  bool counts = true;        // false: rotations are exact
  double wheel_noise = 0.0;  // m per root metre, each wheel
  double truth_position_noise_m = 0.0;
  double truth_heading_noise_rad = 0.0;
  Pose start;
  std::function<void(InjectedStep&)> inject;  // may be empty
};

inline Recording generated(const GeneratorSettings& g, const SpeedProfile& profile, Random& random) {
  const double dt = g.step_s;
  const long steps = std::lround(g.duration_s / dt);
  std::vector<double> left_path{0.0}, right_path{0.0};
  std::vector<Pose> poses{g.start};
  double left = 0.0, right = 0.0, left_read = 0.0, right_read = 0.0;
  Pose pose = g.start;
  for (long i = 0; i < steps; ++i) {
    const WheelSpeedsAt w = profile((static_cast<double>(i) + 0.5) * dt);
    InjectedStep step{static_cast<double>(i) * dt, dt, pose, left, right, w.left_radps, w.right_radps,
                      g.drive.wheel_radius_left_m * w.left_radps * dt, g.drive.wheel_radius_right_m * w.right_radps * dt,
                      w.left_radps * dt, w.right_radps * dt, 0.0, 0.0, {}};
    if (g.inject) g.inject(step);
    left += w.left_radps * dt;
    right += w.right_radps * dt;
    left_read += step.left_read_rad;
    right_read += step.right_read_rad;
    const double l = step.left_m, r = step.right_m;
    const double slip_l = g.wheel_noise > 0.0 ? g.wheel_noise * std::sqrt(std::abs(l)) * random.normal() : 0.0;
    const double slip_r = g.wheel_noise > 0.0 ? g.wheel_noise * std::sqrt(std::abs(r)) * random.normal() : 0.0;
    const double floor_l = l + slip_l, floor_r = r + slip_r;
    const double turn = (floor_r - floor_l) / g.drive.wheelbase_m, way = 0.5 * (floor_l + floor_r);
    const double h = pose.heading_rad;
    if (std::abs(turn) < 1e-12) {
      pose = {pose.x_m + way * std::cos(h), pose.y_m + way * std::sin(h), h + turn};
    } else {  // about the instantaneous centre
      const double radius = way / turn;
      pose = {pose.x_m + radius * (std::sin(h + turn) - std::sin(h)),
              pose.y_m - radius * (std::cos(h + turn) - std::cos(h)), h + turn};
    }
    const double across = h + 0.5 * turn;
    pose = {pose.x_m - step.sideways_m * std::sin(across) + step.room_m.x_m,
            pose.y_m + step.sideways_m * std::cos(across) + step.room_m.y_m, pose.heading_rad + step.turn_rad};
    left_path.push_back(left_read);
    right_path.push_back(right_read);
    poses.push_back(pose);
  }
  const double count_rad = 2.0 * kPi / g.drive.counts_per_wheel_turn();
  const double left_fraction = random.uniform(), right_fraction = random.uniform();  // where within a count it started
  const auto read = [&](double rad, double fraction) {
    return g.counts ? count_rad * std::floor(rad / count_rad + fraction) : rad;
  };
  struct Row {
    double time_s;
    bool wheel;
    std::size_t step;
  };
  std::vector<Row> rows;
  for (double t = 0.0; t <= g.duration_s + 1e-9; t += g.wheel_period_s)
    rows.push_back({t, true, static_cast<std::size_t>(std::lround(t / dt))});
  const auto add_truth = [&](double t) {
    rows.push_back({t + g.truth.time_offset_s, false, static_cast<std::size_t>(std::lround(t / dt))});
  };
  if (g.truth_period_s <= 0.0) {
    add_truth(0.0);
    add_truth(g.duration_s);
  } else {
    for (double t = std::round(g.truth_phase_s / dt) * dt; t <= g.duration_s; t += g.truth_period_s)
      add_truth(std::round(t / dt) * dt);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.time_s < b.time_s; });
  Recording recording;
  recording.name = "generated";
  recording.provenance = "simulated: a drive on paper";
  for (const Row& row : rows) recording.time_s.push_back(row.time_s);
  for (const char* name : {"left_wheel_rad", "right_wheel_rad", "truth_x_m", "truth_y_m"}) recording.add_channel(name);
  if (g.truth_has_heading) recording.add_channel("truth_heading_rad");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t k = std::min(rows[i].step, poses.size() - 1);
    if (rows[i].wheel) {
      recording.channels[0].values[i] = read(left_path[k], left_fraction) - read(0.0, left_fraction);
      recording.channels[1].values[i] = read(right_path[k], right_fraction) - read(0.0, right_fraction);
    } else {
      const Pose& m = g.truth.axle_T_tracked;
      const double h = poses[k].heading_rad;
      recording.channels[2].values[i] =
          poses[k].x_m + m.x_m * std::cos(h) - m.y_m * std::sin(h) + g.truth_position_noise_m * random.normal();
      recording.channels[3].values[i] =
          poses[k].y_m + m.x_m * std::sin(h) + m.y_m * std::cos(h) + g.truth_position_noise_m * random.normal();
      if (g.truth_has_heading)
        recording.channels[4].values[i] =
            std::remainder(h + m.heading_rad + g.truth_heading_noise_rad * random.normal(), 2.0 * kPi);
    }
  }
  return recording;
}

// Straights, arcs both ways, spins, stops and a stretch in reverse, smooth; repeats every 20 s.
inline WheelSpeedsAt rich_driving(double t) {
  const double u = std::fmod(t, 20.0);
  const auto bump = [&](double from, double to) {  // 0 to 1 to 0, smooth
    if (u <= from || u >= to) return 0.0;
    const double edge = std::min({1.0, (u - from) / 0.5, (to - u) / 0.5});
    return 0.5 - 0.5 * std::cos(kPi * edge);
  };
  const double forward = 4.0 * bump(0.0, 5.0) + 3.0 * bump(6.5, 10.0) + 3.0 * bump(12.0, 15.0) - 2.5 * bump(15.5, 17.5);
  const double turning = 2.5 * bump(5.2, 6.4) + 1.0 * bump(7.0, 9.5) - 2.5 * bump(10.2, 11.8) - 1.2 * bump(12.5, 14.5) +
                         2.5 * bump(17.8, 19.6) + 0.1 * std::sin(1.7 * t) * bump(0.0, 5.0);
  return {forward - turning, forward + turning};
}

// A square with stops and turns on the spot, as the drive that the robot believes to be would close it.
inline SpeedProfile square_driving(const DifferentialDrive& believed, double side_m, bool clockwise,
                                   double* duration_s) {
  const double straight_s = 20.0 * side_m / 4.0, turn_s = 4.0;
  const double leg_s = straight_s + turn_s;
  *duration_s = 4.0 * leg_s;
  return [=](double t) {
    const double u = std::fmod(t, leg_s);
    const auto hump = [](double v, double length) {
      return (1.0 - std::cos(2.0 * kPi * v / length)) / length;
    };  // area 1
    if (t >= 4.0 * leg_s) return WheelSpeedsAt{};
    if (u < straight_s) {
      const double speed = side_m * hump(u, straight_s);
      return WheelSpeedsAt{speed / believed.wheel_radius_left_m, speed / believed.wheel_radius_right_m};
    }
    const double speed = (clockwise ? -1.0 : 1.0) * 0.25 * kPi * believed.wheelbase_m * hump(u - straight_s, turn_s);
    return WheelSpeedsAt{-speed / believed.wheel_radius_left_m, speed / believed.wheel_radius_right_m};
  };
}

}  // namespace odolab::test
