#include "core/diagnosis/effects/effect.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/forms.h"

namespace odolab {

const char* component_of(Wheel wheel) {
  return wheel == Wheel::left ? "left_wheel" : wheel == Wheel::right ? "right_wheel" : "both_wheels";
}

Vec2 place_of_wheel(const EffectStep& s, double wheelbase_m, Wheel wheel) {
  const double side = wheel == Wheel::left ? 1.0 : -1.0;
  return s.position + 0.5 * side * wheelbase_m * Vec2{-s.sin_heading, s.cos_heading};
}

BodyMotion by_wheel(Wheel wheel, double extra_m, double wheelbase_m) {
  if (wheel == Wheel::both) return {extra_m, 0.0, 0.0};
  return {0.5 * extra_m, 0.0, (wheel == Wheel::right ? extra_m : -extra_m) / wheelbase_m};
}

std::vector<std::vector<double>> moments(const std::vector<DriveView>& views, double apart_s,
                                         const std::function<bool(const EffectStep&)>& may_happen) {
  constexpr double kMost = 2500.0;
  double span_s = 0.0;
  for (const DriveView& v : views)
    if (!v.steps.empty()) span_s += v.steps.back().time_s - v.steps.front().time_s;
  std::vector<std::vector<double>> found;
  for (const DriveView& v : views) {
    double next_s = -1e300, rolled_m = 0.0;
    for (const EffectStep& s : v.steps) {
      rolled_m += s.rolled_m();
      if (rolled_m <= 0.05 || s.time_s < next_s || !may_happen(s)) continue;
      found.push_back({static_cast<double>(v.number), s.time_s});
      next_s = s.time_s + std::max(apart_s, span_s / kMost);
    }
  }
  return found;
}

std::size_t DriveView::step_at(double time_s) const {
  return static_cast<std::size_t>(
      std::lower_bound(steps.begin(), steps.end(), time_s, [](const EffectStep& s, double t) { return s.time_s < t; }) -
      steps.begin());
}

std::vector<char> DriveView::turning() const {
  const auto n = steps.size();
  std::vector<char> out(n, 0);
  std::size_t from = 0, to = 0;  // of the steps close by
  int turns = 0;
  const auto counted = [&](std::size_t i) {
    return steps[i].left_read_rad != 0.0 || steps[i].right_read_rad != 0.0 ? 1 : 0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    while (to < n && steps[to].time_s <= steps[i].time_s + effects::kTurningWithin_s) turns += counted(to++);
    while (steps[from].time_s < steps[i].time_s - effects::kTurningWithin_s) turns -= counted(from++);
    out[i] = turns > 0;
  }
  return out;
}

namespace {

// What the wheels did in an interval, by these readings.
void put_way(EffectStep& s, const DifferentialDrive& drive, const WheelSample& start, const WheelSample& from,
             const WheelSample& to) {
  s.left_m = drive.wheel_radius_left_m * (to.left_rad - from.left_rad);
  s.right_m = drive.wheel_radius_right_m * (to.right_rad - from.right_rad);
  s.turn_rad = (s.right_m - s.left_m) / drive.wheelbase_m;
  s.left_rad = 0.5 * (from.left_rad + to.left_rad) - start.left_rad;
  s.right_rad = 0.5 * (from.right_rad + to.right_rad) - start.right_rad;
  s.left_by_rad = to.left_rad - from.left_rad;
  s.right_by_rad = to.right_rad - from.right_rad;
}

// How fast the wheels turned in the interval between two readings, and how that changed.
void put_speeds(EffectStep& s, const DifferentialDrive& drive, const WheelSample& from, const WheelSample& to,
                const WheelAcceleration& of) {
  const double rl = drive.wheel_radius_left_m, rr = drive.wheel_radius_right_m, base = drive.wheelbase_m;
  if (s.duration_s > 0.0) {  // two readings may have one stamp
    s.left_radps = (to.left_rad - from.left_rad) / s.duration_s;
    s.right_radps = (to.right_rad - from.right_rad) / s.duration_s;
  }
  s.speed_mps = 0.5 * (rl * s.left_radps + rr * s.right_radps);
  s.yaw_rate_radps = (rr * s.right_radps - rl * s.left_radps) / base;
  s.left_mps2 = rl * of.left_radps2;
  s.right_mps2 = rr * of.right_radps2;
  const double left_mps2 = rl * of.left_steady_radps2, right_mps2 = rr * of.right_steady_radps2;
  s.acceleration_mps2 = 0.5 * (left_mps2 + right_mps2);
  s.yaw_acceleration_radps2 = (right_mps2 - left_mps2) / base;
}

}  // namespace

DriveView as_it_lags(DriveView view, const Motions& lag) {
  constexpr double kStands_mps = 1e-3;  // at such a speed: an exponential has no end
  if (view.steps.empty()) return view;
  const DifferentialDrive& drive = view.drive;
  std::vector<WheelSample> wheels(1);  // as they turn
  wheels[0].time_s = view.steps[0].time_s - 0.5 * view.steps[0].duration_s;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    EffectStep& s = view.steps[i];
    const BodyMotion by = lag.at(i);
    s.late_left_m = by.forward_m - 0.5 * drive.wheelbase_m * by.turn_rad;
    s.late_right_m = by.forward_m + 0.5 * drive.wheelbase_m * by.turn_rad;
    WheelSample next = wheels.back();
    next.time_s += s.duration_s;
    next.left_rad += (s.left_m + s.late_left_m) / drive.wheel_radius_left_m;
    next.right_rad += (s.right_m + s.late_right_m) / drive.wheel_radius_right_m;
    wheels.push_back(next);
  }
  const std::vector<WheelAcceleration> accelerations = wheel_accelerations(wheels);
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    EffectStep& s = view.steps[i];
    const double told_turn_rad = s.turn_rad;
    put_way(s, drive, wheels.front(), wheels[i], wheels[i + 1]);
    s.late_turn_rad = s.turn_rad - told_turn_rad;
    put_speeds(s, drive, wheels[i], wheels[i + 1], accelerations[i]);
    const auto read_rad = [&](double told_rad, double by_rad, double way_m) {
      return told_rad != 0.0 || std::abs(way_m) > kStands_mps * s.duration_s ? by_rad : 0.0;
    };
    s.left_read_rad = read_rad(s.left_read_rad, s.left_by_rad, s.left_m);
    s.right_read_rad = read_rad(s.right_read_rad, s.right_by_rad, s.right_m);
  }
  return view;
}

DriveView as_read(DriveView view, const InnovationRun& run) {
  if (view.from_commands) return view;
  for (std::size_t i = 0; i < view.steps.size(); ++i)
    put_way(view.steps[i], view.drive, run.wheels.front(), run.wheels[i], run.wheels[i + 1]);
  return view;
}

DriveView drive_view(int number, const InnovationRun& run, const DifferentialDrive& drive, bool from_commands,
                     const Track& truth_poses, Way way) {
  DriveView view;
  view.number = number;
  view.recording = run.name;
  view.drive = drive;
  view.from_commands = from_commands;
  const std::vector<WheelSample>& smooth = run.smooth.empty() ? run.wheels : run.smooth;
  const std::vector<WheelSample>& wheels = way == Way::smoothed ? smooth : run.wheels;
  std::vector<DriveStep> reckoned;
  if (truth_poses.empty()) reckoned = drive_steps(run, drive);
  const int n = static_cast<int>(run.wheels.size()) - 1;
  view.steps.resize(n);
  std::size_t k = 0;
  for (int i = 0; i < n; ++i) {
    const WheelSample &a = wheels[i], &b = wheels[i + 1];
    EffectStep& s = view.steps[i];
    s.time_s = 0.5 * (run.wheels[i].time_s + run.wheels[i + 1].time_s);
    s.duration_s = run.wheels[i + 1].time_s - run.wheels[i].time_s;
    s.since_start_s = s.time_s - run.wheels.front().time_s;
    put_way(s, drive, wheels.front(), a, b);
    s.left_read_rad = run.wheels[i + 1].left_rad - run.wheels[i].left_rad;
    s.right_read_rad = run.wheels[i + 1].right_rad - run.wheels[i].right_rad;
    if (truth_poses.empty()) {
      s.heading_rad = reckoned[i].heading_rad;
      s.position = reckoned[i].position;
    } else {
      while (k + 2 < truth_poses.size() && truth_poses[k + 1].time_s <= s.time_s) ++k;
      const TimedPose &p = truth_poses[k], &q = truth_poses[std::min(k + 1, truth_poses.size() - 1)];
      const double gap = q.time_s - p.time_s;
      const double share = gap > 0.0 ? std::clamp((s.time_s - p.time_s) / gap, 0.0, 1.0) : 0.0;
      s.position = p.pose.position() + share * (q.pose.position() - p.pose.position());
      s.heading_rad = p.pose.heading_rad + share * wrapped(q.pose.heading_rad - p.pose.heading_rad);
    }
  }
  double longest_m2 = 0.0;
  for (int i = 0; i + 1 < n; ++i) {
    const Vec2 step = view.steps[i + 1].position - view.steps[i].position;
    longest_m2 = std::max(longest_m2, dot(step, step));
  }
  view.longest_step_m = std::max(view.longest_step_m, std::sqrt(longest_m2));
  for (EffectStep& s : view.steps) s.cos_heading = std::cos(s.heading_rad), s.sin_heading = std::sin(s.heading_rad);
  const std::vector<WheelAcceleration> reckoned_now =
      run.accelerations.empty() ? wheel_accelerations(run.wheels) : std::vector<WheelAcceleration>{};
  const std::vector<WheelAcceleration>& accelerations = run.accelerations.empty() ? reckoned_now : run.accelerations;
  for (int i = 0; i < n; ++i) put_speeds(view.steps[i], drive, smooth[i], smooth[i + 1], accelerations[i]);
  return view;
}

const std::vector<Effect>& catalogue() {
  static const std::vector<Effect> all = [] {
    std::vector<Effect> list;
    for (auto entry : {effects::wheel_eccentricity,
                       effects::encoder_missed_counts,
                       effects::drivetrain_backlash,
                       effects::wheel_toe,
                       effects::castor_reversal_kick,
                       effects::radius_drift,
                       effects::tyre_compression,
                       effects::speed_dependent_radius,
                       effects::payload_radius_change,
                       effects::lateral_slip,
                       effects::traction_slip,
                       effects::turn_scrub,
                       effects::one_sided_drag,
                       effects::bump_across,
                       effects::bump,
                       effects::slip_zone,
                       effects::floor_slope_creep,
                       effects::collision,
                       effects::turn_speed_loss,
                       effects::clock_rate,
                       effects::truth_smoothing,
                       effects::actuator_lag})
      for (Effect& e : entry()) list.push_back(std::move(e));
    return list;
  }();
  return all;
}

const Effect* catalogue_entry(const ActiveEffect& active) {
  const auto given = [&](const Effect::Amplitude& shape) {
    return !is_estimated(shape) || std::any_of(active.parameters.begin(), active.parameters.end(),
                                               [&](const auto& p) { return p.first == shape.name; });
  };
  const Effect* best = nullptr;
  int best_fit = -1;
  for (const Effect& e : catalogue()) {
    if (e.name != active.effect) continue;
    const int fit = 2 * (e.component == active.component) + std::all_of(e.shapes.begin(), e.shapes.end(), given);
    if (fit > best_fit) best = &e, best_fit = fit;
  }
  return best;
}

}  // namespace odolab
