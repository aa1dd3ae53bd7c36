#include "physics/experiments/concealed/driven_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/recording/truth_left_out.h"
#include "physics/experiments/concealed/own_effects.h"
#include "physics/simulation.h"

namespace odolab::concealed {

namespace {

enum Stream : std::uint64_t { kWheelStream = 11, kStampStream = 12 };

std::vector<std::shared_ptr<planar::Effect>> own_effects(const RunPlan& plan) {
  std::vector<std::shared_ptr<planar::Effect>> own;
  const double step_s = plan.robot.scenario.step_s;
  for (const DrawnEffect& e : plan.effects)
    if (const OutsideEffect* outside = e.outside ? outside_effect(e.active.effect) : nullptr) {
      ActiveEffect active = e.active;
      active.parameters.push_back({"start_x_m", plan.drive.start.x_m});
      active.parameters.push_back({"start_y_m", plan.drive.start.y_m});
      own.push_back(outside->make(active, step_s));
    }
  if (plan.noise && plan.robot.rolling_noise_m_per_sqrt_m > 0.0)
    own.push_back(rolling_noise(plan.robot.rolling_noise_m_per_sqrt_m, plan.robot.scenario.actual.wheel_radius_left_m,
                                seed_of_stream(plan.seed, kWheelStream), step_s));
  return own;
}

// The truth comes by a clock that trembles: rows of their own, stamped so.
Recording with_trembling_stamps(const Recording& clean, double jitter_s, std::uint64_t seed) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  struct Row {
    double time_s;
    std::size_t from;
    bool truth;
  };
  Random random(seed);
  const Channel* x = clean.channel("truth_x_m");
  const Channel* wheel = clean.channel("left_wheel_rad");
  std::vector<Row> rows;
  for (std::size_t i = 0; i < clean.time_s.size(); ++i) {
    if (wheel && !std::isnan(wheel->values[i])) rows.push_back({clean.time_s[i], i, false});
    if (x && !std::isnan(x->values[i]))
      rows.push_back({clean.time_s[i] + std::clamp(jitter_s * random.normal(), -2e-3, 2e-3), i, true});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.time_s < b.time_s; });
  Recording out;
  out.name = clean.name;
  out.provenance = clean.provenance;
  for (const Row& row : rows) out.time_s.push_back(row.time_s);
  for (const Channel& channel : clean.channels) {
    const bool of_truth = is_of_truth(channel.name);
    std::vector<double> values;
    for (const Row& row : rows) values.push_back(row.truth == of_truth ? channel.values[row.from] : none);
    out.channels.push_back({channel.name, std::move(values)});
  }
  return out;
}

// Steps are even, so that the place in the track is known.
Pose pose_at(const StampedTrack& stamped, double stamp_s) {
  const Track& track = stamped.track;
  const double step_s = track.size() > 1 ? track.back().time_s / static_cast<double>(track.size() - 1) : 1.0;
  const double at =
      std::clamp(stamp_s / (1.0 + stamped.clock_rate) / step_s, 0.0, static_cast<double>(track.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(at), track.size() - 1), j = std::min(i + 1, track.size() - 1);
  const double u = at - static_cast<double>(i);
  const Pose &a = track[i].pose, &b = track[j].pose;
  return {a.x_m + u * (b.x_m - a.x_m), a.y_m + u * (b.y_m - a.y_m),
          a.heading_rad + u * (b.heading_rad - a.heading_rad)};
}

// In the frame of the middle heading.
BodyMotion motion(const Pose& from, const Pose& to) {
  const double turn = to.heading_rad - from.heading_rad;
  const Vec2 way = rotated(to.position() - from.position(), -(from.heading_rad + 0.5 * turn));
  return {way.x_m, way.y_m, turn};
}

}  // namespace

Scenario RunPlan::scenario() const {
  Scenario s = robot.scenario;
  s.name = drive.name;
  s.path = drive.path;
  s.driving = drive.driving;
  s.start = drive.start;
  s.seed = seed;
  if (!noise) s.floor.roughness = {};
  for (const DrawnEffect& e : effects)
    if (!e.outside) s.effects.push_back(e.active);
  return s;
}

double RunPlan::clock_rate() const {
  double rate = 0.0;
  for (const DrawnEffect& e : effects)
    if (e.active.effect == "clock_rate") rate += e.active.parameter("rate");
  return rate;
}

DrivenRun driven(const RunPlan& plan) {
  Simulation simulation(plan.scenario(), plan.seed, nullptr, own_effects(plan));
  DrivenRun out;
  const auto keep = [&] {
    const SimulationState& s = simulation.state();
    out.true_axle.push_back({s.time_s, s.true_pose});
    out.counted.push_back({s.time_s, s.left.counted_rad, s.right.counted_rad});
  };
  keep();
  while (!simulation.state().finished && simulation.state().time_s < plan.longest_s) {
    simulation.step();
    keep();
  }
  out.recording =
      with_trembling_stamps(simulation.recording(), plan.robot.stamp_jitter_s, seed_of_stream(plan.seed, kStampStream));
  return out;
}

Track driven_again(const RunPlan& plan, const std::vector<WheelSample>& counted) {
  auto wheels = std::make_shared<Recording>();
  std::vector<double> left, right, x(counted.size(), std::numeric_limits<double>::quiet_NaN()), y = x, heading = x;
  for (const WheelSample& w : counted) {
    wheels->time_s.push_back(w.time_s);
    left.push_back(w.left_rad);
    right.push_back(w.right_rad);
  }
  const Pose tracked = plan.drive.start * plan.robot.scenario.vehicle.truth.axle_T_tracked;
  x[0] = tracked.x_m, y[0] = tracked.y_m, heading[0] = tracked.heading_rad;
  wheels->channels = {{"left_wheel_rad", left},
                      {"right_wheel_rad", right},
                      {"truth_x_m", x},
                      {"truth_y_m", y},
                      {"truth_heading_rad", heading}};
  Scenario scenario = plan.scenario();
  scenario.path = ReplayPath{};
  std::erase_if(scenario.effects, [](const ActiveEffect& e) { return e.effect == "clock_rate"; });  // stamps alone
  Simulation simulation(scenario, plan.seed, wheels, own_effects(plan));
  Track track;
  track.push_back({0.0, simulation.state().true_pose});
  while (!simulation.state().finished) {
    simulation.step();
    track.push_back({simulation.state().time_s, simulation.state().true_pose});
  }
  return track;
}

std::vector<BodyMotion> difference(const std::vector<WheelSample>& wheels, const StampedTrack& with,
                                   const StampedTrack& without) {
  std::vector<BodyMotion> out;
  for (std::size_t i = 0; i + 1 < wheels.size(); ++i) {
    const BodyMotion m = motion(pose_at(with, wheels[i].time_s), pose_at(with, wheels[i + 1].time_s));
    const BodyMotion n = motion(pose_at(without, wheels[i].time_s), pose_at(without, wheels[i + 1].time_s));
    out.push_back({m.forward_m - n.forward_m, m.sideways_m - n.sideways_m, m.turn_rad - n.turn_rad});
  }
  return out;
}

}  // namespace odolab::concealed
