// Recordings with known physics left out of the model: each effect written as what happens on the floor in steps of
// half a millisecond, not as the diagnosis has it.
#pragma once

#include <memory>

#include "test/support/drive_generator.h"

namespace odolab::test {

struct Case {
  std::vector<Recording> recordings;
  Vehicle nominal;
  std::string effect;  // empty: none
  std::string component;
  DifferentialDrive actual;
  std::vector<std::pair<std::string, double>>
      truth;  // the effect's parameters by the catalogue's names, as far as it has them
};

struct CaseSettings {
  std::string effect;
  double size = 1.0;  // 1: medium
  int runs = 4;
  double duration_s = 60.0;
  enum class Truth { mocap, coarse, coarse_without_heading, ends } truth = Truth::mocap;
  enum class Drive { rich, squares } drive = Drive::rich;
  bool without_noise = false;  // nor whole counts
  double truth_late_s = 0.0;   // its clock, against the wheels'
};

// Smooth driving of many kinds, other at each seed and run: straights, arcs, turns on the spot, stops, reverse.
inline SpeedProfile varied_driving(Random& random, double duration_s) {
  struct Leg {
    double from, to, forward, turning;
  };
  auto legs = std::make_shared<std::vector<Leg>>();
  const double speed = random.uniform(3.0, 7.0);
  for (double t = 0.3; t < duration_s;) {
    const double kind = random.uniform(), length = random.uniform(2.0, 4.5);
    Leg leg{t, t + length, 0.0, 0.0};
    const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
    const double v = speed * random.uniform(0.4, 1.0);
    if (kind < 0.3)
      leg.forward = v;
    else if (kind < 0.6)
      leg.forward = v, leg.turning = sign * random.uniform(0.4, 1.2);
    else if (kind < 0.8)
      leg.turning = sign * random.uniform(1.5, 3.0), leg.to = t + random.uniform(1.0, 2.0);
    else
      leg.forward = -0.6 * v, leg.turning = random.uniform() < 0.5 ? 0.0 : sign * 0.4;
    legs->push_back(leg);
    t = leg.to + (random.uniform() < 0.3 ? 0.5 : -0.35);
  }
  return [legs](double t) {
    WheelSpeedsAt w;
    for (const Leg& l : *legs) {
      if (t <= l.from || t >= l.to) continue;
      const double edge = std::min({1.0, (t - l.from) / 0.4, (l.to - t) / 0.4});
      const double s = 0.5 - 0.5 * std::cos(kPi * edge);
      w.left_radps += s * (l.forward - l.turning);
      w.right_radps += s * (l.forward + l.turning);
    }
    return w;
  };
}

// Followed by motion capture, of a millimetre and two milliradians where nothing else is said.
inline GeneratorSettings under_motion_capture(const DifferentialDrive& drive, double wheel_noise, double truth_period_s,
                                              double noise_m = 0.001, double noise_rad = 0.002) {
  GeneratorSettings g;
  g.drive = drive;
  g.wheel_noise = wheel_noise;
  g.truth_period_s = truth_period_s;
  g.truth_position_noise_m = noise_m;
  g.truth_heading_noise_rad = noise_rad;
  return g;
}

// Three runs of one robot, each with its driving and with what is injected into it.
inline std::vector<Recording> three_runs(GeneratorSettings g, Random& random,
                                         const std::function<SpeedProfile(int run)>& driving,
                                         const std::function<std::function<void(InjectedStep&)>(int run)>& inject) {
  std::vector<Recording> recordings;
  for (int run = 0; run < 3; ++run) {
    const SpeedProfile profile = driving(run);
    g.inject = inject(run);
    recordings.push_back(generated(g, profile, random));
    recordings.back().name = "run_" + std::to_string(run + 1);
  }
  return recordings;
}

inline std::function<void(InjectedStep&)> injected(const std::string& effect, double size,
                                                   const DifferentialDrive& drive, int run, double duration_s,
                                                   Random& random) {
  const double b = drive.wheelbase_m;
  const double rl = drive.wheel_radius_left_m, rr = drive.wheel_radius_right_m;
  const auto speed = [=](const InjectedStep& s) { return 0.5 * (rl * s.left_radps + rr * s.right_radps); };
  const auto yaw = [=](const InjectedStep& s) { return (rr * s.right_radps - rl * s.left_radps) / b; };
  const double phase = random.uniform(0.0, 2.0 * kPi);
  if (effect == "wheel_eccentricity")
    return [=](InjectedStep& s) { s.left_m *= 1.0 + 0.005 * size * std::sin(s.left_rad + phase); };
  if (effect == "encoder_missed_counts")
    return [=](InjectedStep& s) {
      if (std::abs(s.right_radps) > 3.0) s.right_read_rad *= 1.0 - 0.01 * size;
    };
  if (effect == "drivetrain_backlash") {
    auto place = std::make_shared<double>(0.0);
    return [=](InjectedStep& s) {
      const double half = 0.5 * 0.03 * size, by = s.left_radps * s.dt_s;
      const double next = std::clamp(*place + by, -half, half);
      s.left_m = rl * (by - (next - *place));
      *place = next;
    };
  }
  if (effect == "wheel_toe") return [=](InjectedStep& s) { s.sideways_m += 0.005 * size * speed(s) * s.dt_s; };
  if (effect == "castor_reversal_kick") {
    auto direction = std::make_shared<int>(0);
    auto left_to_go = std::make_shared<double>(0.0);
    auto sign = std::make_shared<double>(0.0);
    return [=](InjectedStep& s) {
      const double v = speed(s);
      if (std::abs(v) > 0.01) {
        const int now = v > 0.0 ? 1 : -1;
        if (*direction != 0 && now != *direction) *left_to_go = 0.04, *sign = now;
        *direction = now;
      }
      if (*left_to_go > 0.0) {
        const double way = std::min(*left_to_go, std::abs(v) * s.dt_s);
        s.turn_rad += *sign * 0.01 * size * way / 0.04;
        *left_to_go -= way;
      }
    };
  }
  if (effect == "radius_drift") return [=](InjectedStep& s) { s.right_m *= 1.0 + 1e-4 * size * s.time_s; };
  if (effect == "tyre_compression")
    return [=](InjectedStep& s) {
      const double a = speed(s) * yaw(s), c = 0.0005 * size * a;
      s.left_m += c * s.left_radps * s.dt_s;
      s.right_m -= c * s.right_radps * s.dt_s;
    };
  if (effect == "speed_dependent_radius")
    return [=](InjectedStep& s) {
      const double k = 1.0 + 0.02 * size * std::abs(speed(s));
      s.left_m *= k, s.right_m *= k;
    };
  if (effect == "payload_radius_change") {
    const double at = random.uniform(0.35, 0.65) * duration_s;
    return [=](InjectedStep& s) {
      if (run == 1 && s.time_s > at) s.left_m -= 0.0004 * size * s.left_radps * s.dt_s;
    };
  }
  if (effect == "lateral_slip")
    return [=](InjectedStep& s) { s.sideways_m -= 0.02 * size * speed(s) * yaw(s) * s.dt_s; };
  if (effect == "traction_slip") {
    auto before = std::make_shared<double>(0.0);
    return [=](InjectedStep& s) {
      const double v = speed(s), a = (v - *before) / s.dt_s;
      *before = v;
      const double slip = 0.02 * size * a * (v > 0.0 ? 1.0 : -1.0);
      s.left_m -= slip * v * s.dt_s, s.right_m -= slip * v * s.dt_s;
    };
  }
  if (effect == "turn_scrub")
    return
        [=](InjectedStep& s) { s.turn_rad += yaw(s) * s.dt_s * (1.0 / (1.0 + 0.01 * size * std::abs(yaw(s))) - 1.0); };
  if (effect == "one_sided_drag")
    return [=](InjectedStep& s) { s.turn_rad += 0.01 * size * std::abs(speed(s)) * s.dt_s; };
  if (effect == "bump") {
    const double at = random.uniform(0.2, 0.8) * duration_s;
    auto left_to_go = std::make_shared<double>(-1.0);
    return [=](InjectedStep& s) {
      if (run != 0) return;
      if (*left_to_go < 0.0 && s.time_s > at && s.left_radps > 1.0) *left_to_go = 0.05;
      if (*left_to_go > 0.0) {
        const double way = std::min(*left_to_go, s.left_m);
        s.left_m -= 0.01 * size * way / 0.05;
        *left_to_go -= way;
      }
    };
  }
  if (effect == "slip_zone") {
    return [=](InjectedStep& s) {
      const Vec2 centre{0.35, 0.2};
      const Vec2 side = rotated({0.0, 0.5 * b}, s.pose.heading_rad);
      if (length(s.pose.position() + side - centre) < 0.45) s.left_m *= 1.0 - 0.05 * size;
      if (length(s.pose.position() - side - centre) < 0.45) s.right_m *= 1.0 - 0.05 * size;
    };
  }
  if (effect == "floor_slope_creep")
    return [=](InjectedStep& s) {
      if (s.left_radps == 0.0 && s.right_radps == 0.0) return;
      s.room_m = {0.002 * size * s.dt_s * std::cos(phase), 0.002 * size * s.dt_s * std::sin(phase)};
    };
  if (effect == "collision") {
    const double at = random.uniform(0.2, 0.8) * duration_s;
    return [=](InjectedStep& s) {
      if (run == 0 && s.time_s >= at && s.time_s < at + 0.05) {
        s.sideways_m += 0.02 * size * s.dt_s / 0.05;
        s.turn_rad += 0.04 * size * s.dt_s / 0.05;
      }
    };
  }
  if (effect == "turn_speed_loss")
    return [=](InjectedStep& s) {
      const double loss = 0.02 * size * std::abs(yaw(s)) * speed(s) * s.dt_s;
      s.left_m -= loss, s.right_m -= loss;
    };
  // Outside the catalogue.
  if (effect == "magnet")  // drawn towards a place on the floor
    return [=](InjectedStep& s) {
      const Vec2 to = Vec2{0.5, 0.5} - s.pose.position();
      s.turn_rad += 0.03 * size * cross({std::cos(s.pose.heading_rad), std::sin(s.pose.heading_rad)}, to) *
                    std::abs(speed(s)) * s.dt_s;
    };
  if (effect == "compass")  // turned towards a direction of the room
    return [=](InjectedStep& s) {
      s.turn_rad += 0.02 * size * std::sin(s.pose.heading_rad) * std::abs(speed(s)) * s.dt_s;
    };
  if (effect == "cubic_steering")
    return [=](InjectedStep& s) { s.turn_rad += 0.06 * size * yaw(s) * yaw(s) * std::abs(speed(s)) * s.dt_s; };
  if (effect == "waves")  // steered by waves of the floor, a metre and a half along x
    return [=](InjectedStep& s) {
      s.turn_rad += 0.02 * size * std::sin(2.0 * kPi * s.pose.x_m / 1.5) * std::abs(speed(s)) * s.dt_s;
    };
  if (effect == "ripples")  // each wheel rolls further, and less far, by where it stands: 1.5 m along x
    return [=](InjectedStep& s) {
      const double by = 0.02 * size, left_x_m = (s.pose * Vec2{0.0, 0.5 * b}).x_m,
                   right_x_m = (s.pose * Vec2{0.0, -0.5 * b}).x_m;
      s.left_m *= 1.0 + by * std::sin(2.0 * kPi * left_x_m / 1.5);
      s.right_m *= 1.0 + by * std::sin(2.0 * kPi * right_x_m / 1.5);
    };
  if (effect == "gear" || effect == "gear_and_push") {  // of the left wheel: two and a half times a turn
    const auto pushed = injected(effect == "gear" ? "" : "collision", 0.3 * size, drive, run, duration_s, random);
    return [=](InjectedStep& s) {
      s.left_m *= 1.0 + 0.007 * size * std::sin(2.5 * s.left_rad + phase);
      if (pushed) pushed(s);
    };
  }
  if (effect == "gusts")  // carried to and fro, once in six seconds
    return [=](InjectedStep& s) {
      if (speed(s) != 0.0) s.room_m.y_m += 0.002 * size * std::sin(2.0 * kPi * s.time_s / 6.0) * s.dt_s;
    };
  if (effect == "wheelbase_with_time")  // of a robot whose tyres spread, six percent a minute
    return [=](InjectedStep& s) { s.turn_rad -= 1e-3 * size * s.time_s * yaw(s) * s.dt_s; };
  if (effect == "uneven_castor") {  // it pulls to and fro, once in each 0.25 m of its way
    auto way_m = std::make_shared<double>(0.0);
    return [=](InjectedStep& s) {
      *way_m += speed(s) * s.dt_s;
      s.turn_rad += 0.05 * size * std::sin(2.0 * kPi * *way_m / 0.25) * speed(s) * s.dt_s;
    };
  }
  if (effect == "memory")  // twists back after a turn
  {
    auto m = std::make_shared<double>(0.0);
    return [=](InjectedStep& s) {
      *m = *m * std::exp(-std::abs(speed(s)) * s.dt_s / 0.25) + yaw(s) * s.dt_s;
      *m = std::clamp(*m, -1.5, 1.5);
      s.turn_rad -= 0.04 * size * *m * std::abs(speed(s)) * s.dt_s;
    };
  }
  return {};
}

// What was injected, in the catalogue's words. The same draws as `injected` makes.
inline std::vector<std::pair<std::string, double>> injected_parameters(const std::string& effect, double size,
                                                                       const DifferentialDrive& drive,
                                                                       double duration_s, Random random) {
  const double phase = random.uniform(0.0, 2.0 * kPi);
  const auto at = [&](double low, double high) { return random.uniform(low, high) * duration_s; };
  if (effect == "wheel_eccentricity") return {{"amplitude", 0.005 * size}, {"phase_rad", phase}};
  if (effect == "encoder_missed_counts") return {{"fraction", 0.01 * size}, {"above_radps", 3.0}};
  if (effect == "drivetrain_backlash") return {{"gap_rad", 0.03 * size}};
  if (effect == "wheel_toe") return {{"sideways_per_metre", 0.005 * size}};
  if (effect == "castor_reversal_kick") return {{"kick_rad", 0.01 * size}};
  if (effect == "radius_drift") return {{"per_s", 1e-4 * size}};
  if (effect == "tyre_compression") return {{"radius_change_m_per_mps2", 0.0005 * size}};
  if (effect == "speed_dependent_radius") return {{"per_mps", 0.02 * size}};
  if (effect == "payload_radius_change")
    return {{"left", -0.0004 * size / drive.wheel_radius_left_m}, {"right", 0.0}, {"at_s", at(0.35, 0.65)}};
  if (effect == "lateral_slip") return {{"m_per_s_per_mps2", 0.02 * size}};
  if (effect == "traction_slip") return {{"per_mps2", 0.02 * size}};
  if (effect == "turn_scrub") return {{"per_radps", 0.01 * size}};
  if (effect == "one_sided_drag") return {{"rad_per_m", 0.01 * size}};
  if (effect == "bump") return {{"extra_distance_m", 0.01 * size}};
  if (effect == "slip_zone") return {{"slip", 0.05 * size}, {"x_m", 0.35}, {"y_m", 0.2}, {"radius_m", 0.45}};
  if (effect == "floor_slope_creep") return {{"direction_rad", phase}, {"creep_mps", 0.002 * size}};
  if (effect == "collision")
    return {{"dx_m", 0.0}, {"dy_m", 0.02 * size}, {"dheading_rad", 0.04 * size}, {"at_s", at(0.2, 0.8)}};
  if (effect == "turn_speed_loss") return {{"per_radps", 0.02 * size}};
  return {};
}

inline Case generated_case(const CaseSettings& c, std::uint64_t seed) {
  Random random(seed);
  GeneratorSettings g;
  g.drive.wheel_radius_left_m = 0.075 * random.uniform(0.98, 1.02);
  g.drive.wheel_radius_right_m = 0.075 * random.uniform(0.98, 1.02);
  g.drive.wheelbase_m = 0.340 * random.uniform(0.96, 1.04);
  g.wheel_noise = 0.0015 * std::exp(random.uniform(-0.7, 0.7));
  g.duration_s = c.duration_s;
  if (c.truth == CaseSettings::Truth::mocap) {
    g.truth_period_s = random.uniform() < 0.5 ? 1.0 / 60.0 : 0.02;
    g.truth_position_noise_m = 0.001 * std::exp(random.uniform(-0.5, 0.7));
    g.truth_heading_noise_rad = 0.002 * std::exp(random.uniform(-0.5, 0.7));
  } else {
    g.truth_period_s = c.truth == CaseSettings::Truth::ends ? 0.0 : random.uniform(0.1, 0.5);
    g.truth_position_noise_m = c.truth == CaseSettings::Truth::ends ? 0.003 : random.uniform(0.01, 0.03);
    g.truth_heading_noise_rad = c.truth == CaseSettings::Truth::ends ? 0.003 : 0.02;
    g.truth_has_heading = c.truth != CaseSettings::Truth::coarse_without_heading;
  }
  g.truth.time_offset_s = c.truth_late_s;
  if (c.without_noise) {
    g.counts = false;
    g.wheel_noise = g.truth_position_noise_m = g.truth_heading_noise_rad = 0.0;
  }
  Case out;
  out.effect = c.effect;
  out.actual = g.drive;
  out.truth = injected_parameters(c.effect, c.size, g.drive, c.duration_s, Random(seed_of_stream(seed, 77)));
  for (int run = 0; run < c.runs; ++run) {
    SpeedProfile profile = varied_driving(random, g.duration_s);
    if (c.drive == CaseSettings::Drive::squares)
      profile = square_driving(out.nominal.kind.index() == 0 ? std::get<DifferentialDrive>(out.nominal.kind) : g.drive,
                               1.5, run % 2 == 0, &g.duration_s);
    Random same(seed_of_stream(seed, 77));  // phases and directions are those of the robot and the room, not of the run
    g.inject = injected(c.effect, c.size, g.drive, run, g.duration_s, same);
    Recording r = generated(g, profile, random);
    r.name = "run_" + std::to_string(run);
    out.recordings.push_back(std::move(r));
  }
  return out;
}

// The same over 50 s each.
inline Case case_of(const std::string& effect, double size, int runs, std::uint64_t seed) {
  CaseSettings settings;
  settings.effect = effect;
  settings.size = size;
  settings.runs = runs;
  settings.duration_s = 50.0;
  return generated_case(settings, seed);
}

}  // namespace odolab::test
