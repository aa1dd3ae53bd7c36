#include "core/diagnosis/advice/advised_drive.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/calibration/smoothed_readings.h"

namespace odolab {

namespace {

constexpr double kWheelPeriod_s = 0.02;

void rest(AdvisedDrive& m, double duration_s = 0.5) { m.legs.push_back({duration_s, 0.0, 0.0}); }

void straight(AdvisedDrive& m, double length_m, double speed_mps) {
  m.legs.push_back({length_m / std::abs(speed_mps), speed_mps, 0.0});
  rest(m, 1.0);
}

void arc(AdvisedDrive& m, double radius_m, double turn_rad, double speed_mps) {
  const double rate = std::abs(speed_mps) / radius_m;
  m.legs.push_back({std::abs(turn_rad) / rate, speed_mps, turn_rad > 0.0 ? rate : -rate});
  rest(m, 1.0);
}

void spin(AdvisedDrive& m, double turn_rad, double rate_radps) {
  m.legs.push_back({std::abs(turn_rad) / rate_radps, 0.0, turn_rad > 0.0 ? rate_radps : -rate_radps});
  rest(m, 1.0);
}

}  // namespace

double AdvisedDrive::duration_s() const {
  double sum = 0.0;
  for (const DriveLeg& l : legs) sum += l.duration_s;
  return sum;
}

std::vector<AdvisedDrive> advised_drives(const DrivingRange& range) {
  const double fast = range.speed_mps, slow = 0.35 * fast, spin_fast = range.yaw_rate_radps,
               spin_slow = 0.35 * spin_fast;
  const double side = std::clamp(5.0 * fast, 0.3, 3.0), radius = std::max(0.3, fast / (0.8 * spin_fast)),
               wide = 2.5 * radius;
  std::vector<AdvisedDrive> all;
  const auto add = [&](const std::string& sentence) -> AdvisedDrive& {
    all.push_back({sentence, {{0.5, 0.0, 0.0}}});
    return all.back();
  };
  {
    AdvisedDrive& m =
        add(formatted("%.1f m straight forwards and back in reverse, at %.2g and %.2g m/s", side, slow, fast));
    for (double v : {slow, fast}) straight(m, side, v), straight(m, side, -v);
  }
  {
    AdvisedDrive& m = add(formatted("a square of %.1f m both ways at %.2g m/s, turning on the spot", 0.6 * side, fast));
    for (double sense : {1.0, -1.0})
      for (int k = 0; k < 4; ++k) straight(m, 0.6 * side, fast), spin(m, sense * 0.5 * kPi, spin_slow);
  }
  {
    AdvisedDrive& m = add(formatted("turns of %.2g m radius, both ways, at %.2g and %.2g m/s", radius, slow, fast));
    for (double v : {slow, fast}) arc(m, radius, 1.5 * kPi, v), arc(m, radius, -1.5 * kPi, v);
  }
  {
    AdvisedDrive& m = add(formatted("turns of %.2g and of %.2g m radius, both ways, at %.2g m/s", radius, wide, fast));
    for (double r : {radius, wide}) arc(m, r, 1.5 * kPi, fast), arc(m, r, -1.5 * kPi, fast);
  }
  {
    AdvisedDrive& m = add(formatted("turns on the spot, both ways, at %.2g and %.2g rad/s", spin_slow, spin_fast));
    for (double w : {spin_slow, spin_fast}) spin(m, 2.0 * kPi, w), spin(m, -2.0 * kPi, w);
  }
  for (double v : {fast, slow}) {
    AdvisedDrive& m = add(formatted("figures of eight with turns of %.2g m radius at %.2g m/s", radius, v));
    for (int k = 0; k < 2; ++k) {
      arc(m, radius, 2.0 * kPi, v), m.legs.pop_back();
      arc(m, radius, -2.0 * kPi, v), m.legs.pop_back();
    }
    rest(m);
  }
  {
    AdvisedDrive& m =
        add(formatted("a straight of stops and goes, hard on and hard off, up to %.2g m/s, and back in reverse", fast));
    for (double v : {fast, -fast})
      for (int k = 0; k < 6; ++k) m.legs.push_back({1.2, v, 0.0}), rest(m, 1.2);
  }
  {
    AdvisedDrive& m =
        add(formatted("forth and back ten times, 0.3 m each, at %.2g m/s, in turns of %.2g m radius", slow, radius));
    for (int k = 0; k < 10; ++k) {
      const double sense = k % 2 == 0 ? 1.0 : -1.0;
      arc(m, radius, sense * 0.3 / radius, slow), arc(m, radius, -sense * 0.3 / radius, -slow);
    }
  }
  {
    AdvisedDrive& m = add(
        formatted("five times a turn on the spot at %.2g rad/s and then straight off at %.2g m/s", spin_slow, fast));
    for (int k = 0; k < 5; ++k) spin(m, (k % 2 == 0 ? 1.0 : -1.0) * kPi, spin_slow), straight(m, 0.5 * side, fast);
  }
  {
    AdvisedDrive& m = add(formatted("%.1f m straight at %.2g, %.2g and %.2g m/s, turning about at each end", side, slow,
                                    0.65 * fast, fast));
    for (double v : {slow, 0.65 * fast, fast})
      for (int k = 0; k < 2; ++k) straight(m, side, v), spin(m, kPi, spin_slow);
  }
  return all;
}

InnovationRun run_of(const AdvisedDrive& m, const DrivingRange& range, const DifferentialDrive& drive,
                     double truth_period_s, bool truth_has_heading) {
  InnovationRun run;
  run.name = "advice";
  run.truth_has_heading = truth_has_heading;
  const double dt = kWheelPeriod_s, duration = m.duration_s(), half = 0.5 * drive.wheelbase_m;
  double v = 0.0, w = 0.0, left = 0.0, right = 0.0, left_for_s = 0.0;
  Pose pose;
  std::size_t leg = 0;
  double next_truth_s = 0.0;
  left_for_s = m.legs.empty() ? 0.0 : m.legs[0].duration_s;
  for (long i = 0;; ++i) {
    const double t = static_cast<double>(i) * dt;
    run.wheels.push_back({t, left, right});
    if (t + 1e-9 >= next_truth_s || t >= duration) {
      run.truth.push_back({t, pose.position(), pose.heading_rad});
      next_truth_s = truth_period_s > 0.0 ? next_truth_s + truth_period_s : 1e300;
    }
    if (t >= duration) break;
    while (leg + 1 < m.legs.size() && left_for_s <= 0.0) left_for_s += m.legs[++leg].duration_s;
    left_for_s -= dt;
    const DriveLeg& now = m.legs[leg];
    v += std::clamp(now.speed_mps - v, -range.acceleration_mps2 * dt, range.acceleration_mps2 * dt);
    w += std::clamp(now.yaw_rate_radps - w, -range.yaw_acceleration_radps2 * dt, range.yaw_acceleration_radps2 * dt);
    left += (v - half * w) * dt / drive.wheel_radius_left_m;
    right += (v + half * w) * dt / drive.wheel_radius_right_m;
    const double middle = pose.heading_rad + 0.5 * w * dt;
    pose = {pose.x_m + v * dt * std::cos(middle), pose.y_m + v * dt * std::sin(middle), pose.heading_rad + w * dt};
  }
  run.set_aside.assign(run.truth.size(), 0);
  run.smooth = smoothed(run.wheels);
  run.accelerations = wheel_accelerations(run.wheels);
  return run;
}

}  // namespace odolab
