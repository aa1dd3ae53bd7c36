#include "physics/experiments/concealed/drawn_drives.h"

#include <algorithm>
#include <cmath>

namespace odolab::concealed {

namespace {

struct Pace {
  Driving slow, fast;
};

Driving driving(Random& random, double speed_mps, double turn_rate_radps) {
  Driving d;
  d.speed_mps = speed_mps;
  d.turn_rate_radps = turn_rate_radps;
  d.acceleration_mps2 = random.uniform(0.2, 0.6);
  d.turn_acceleration_radps2 = random.uniform(1.0, 2.0);
  return d;
}

SquarePath square(const Driving& d, double duration_s, bool clockwise) {
  const double corner_s = 0.5 * kPi / d.turn_rate_radps + d.turn_rate_radps / d.turn_acceleration_radps2 + 0.6;
  const double side_s = duration_s / 4.0 - corner_s - d.speed_mps / d.acceleration_mps2;
  return {std::clamp(side_s * d.speed_mps, 0.8, 5.0), clockwise};
}

FigureEightPath eight(Random& random, const Driving& d, double duration_s) {
  const double radius_m = random.uniform(0.5, 1.1);
  const double loops = duration_s * d.speed_mps / (4.0 * kPi * radius_m);
  return {radius_m, std::max(1, static_cast<int>(std::lround(loops)))};
}

WaypointPath waypoints(Random& random, const Driving& d, double duration_s) {
  WaypointPath path;
  Vec2 last;
  for (double t = 0.0; t < duration_s;) {
    Vec2 next = last;
    while (length(next - last) < 0.6) next = {random.uniform(-1.6, 1.6), random.uniform(-1.6, 1.6)};
    t += length(next - last) / d.speed_mps + 2.0 / d.turn_rate_radps + 2.0;
    path.points.push_back(next);
    last = next;
  }
  return path;
}

// Spins, arcs, starts and stops, forward and in reverse, by wheel speeds alone.
WheelSpeedPath by_wheels(Random& random, const Driving& d, double duration_s, double wheel_radius_m, bool spins) {
  WheelSpeedPath path;
  path.ramp_s = 0.8;
  const double speed = d.speed_mps / wheel_radius_m;
  double direction = 1.0;
  for (double t = 0.0; t < duration_s;) {
    WheelSpeeds phase;
    phase.duration_s = random.uniform(2.0, 4.5);
    const double v = speed * random.uniform(0.5, 1.0), kind = random.uniform(),
                 side = random.uniform() < 0.5 ? -1.0 : 1.0;
    if (kind < (spins ? 0.55 : 0.15)) {
      phase.left_radps = -side * v * 0.5, phase.right_radps = side * v * 0.5;
    } else {
      const double bend = side * random.uniform(0.0, 0.45);
      if (random.uniform() < 0.4) direction = -direction;
      phase.left_radps = direction * v * (1.0 - bend), phase.right_radps = direction * v * (1.0 + bend);
    }
    path.phases.push_back(phase);
    t += phase.duration_s;
    if (random.uniform() < 0.35) {
      path.phases.push_back({1.2, 0.0, 0.0});
      t += 1.2;
    }
  }
  return path;
}

enum DriveKind {
  eight_slow,
  eight_fast,
  square_ccw,
  square_cw,
  there_and_back,
  points,
  spinning,
  shunting,
  kDriveKinds
};

DrawnDrive draw_drive(Random& random, DriveKind kind, const Pace& pace) {
  DrawnDrive out;
  const double duration_s = random.uniform(40.0, 80.0);
  out.start = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-kPi, kPi)};
  out.driving = random.uniform() < 0.5 ? pace.slow : pace.fast;
  switch (kind) {
    case eight_slow:
      out.name = "eight_slow";
      out.driving = pace.slow;
      out.path = eight(random, out.driving, duration_s);
      break;
    case eight_fast:
      out.name = "eight_fast";
      out.driving = pace.fast;
      out.path = eight(random, out.driving, duration_s);
      break;
    case square_ccw:
    case square_cw:
      out.name = kind == square_cw ? "square_cw" : "square_ccw";
      out.path = square(out.driving, duration_s, kind == square_cw);
      break;
    case there_and_back:
      out.name = "there_and_back";
      out.driving = pace.slow;
      out.path = StraightPath{0.5 * duration_s * out.driving.speed_mps, true};
      break;
    case points:
      out.name = "waypoints";
      out.path = waypoints(random, out.driving, duration_s);
      break;
    case spinning:
    case shunting:
    case kDriveKinds:
      out.name = kind == spinning ? "spins" : "shunting";
      out.path = by_wheels(random, out.driving, duration_s, 0.075, kind == spinning);
      break;
  }
  return out;
}

}  // namespace

DrawnDrives drawn_drives(Random& random, bool poor) {
  Pace pace;
  pace.slow = driving(random, random.uniform(0.18, 0.3), random.uniform(0.5, 0.9));
  pace.fast = driving(random, random.uniform(0.4, 0.6), random.uniform(1.0, 1.6));
  DrawnDrives drives;
  if (poor) {
    const double side_m = random.uniform(2.0, 4.0);
    for (int run = 0; run < 6; ++run) {
      DrawnDrive d = draw_drive(random, run % 2 == 0 ? square_cw : square_ccw, pace);
      d.driving = pace.slow;
      d.path = SquarePath{side_m, run % 2 == 0};
      d.name += "_" + std::to_string(run / 2 + 1);
      drives.given.push_back(d);
    }
    for (DriveKind kind : {eight_fast, shunting}) drives.held_out.push_back(draw_drive(random, kind, pace));
  } else {
    DriveKind kinds[kDriveKinds];
    for (int k = 0; k < kDriveKinds; ++k) kinds[k] = static_cast<DriveKind>(k);
    for (int k = kDriveKinds - 1; k > 0; --k) {  // shuffled
      const int other = std::min(k, static_cast<int>(random.uniform() * (k + 1.0)));
      std::swap(kinds[k], kinds[other]);
    }
    const int given = 4 + std::min(2, static_cast<int>(random.uniform() * 3.0));
    for (int k = 0; k < given; ++k) drives.given.push_back(draw_drive(random, kinds[k], pace));
    for (int k = given; k < given + 2; ++k) drives.held_out.push_back(draw_drive(random, kinds[k], pace));
  }
  for (DrawnDrive& d : drives.held_out) d.name = "held_out_" + d.name;
  return drives;
}

}  // namespace odolab::concealed
