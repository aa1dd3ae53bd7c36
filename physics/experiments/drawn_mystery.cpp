#include "physics/experiments/drawn_mystery.h"

#include <algorithm>

#include "physics/model_replay.h"

namespace odolab {

namespace {

constexpr double kNothingShare = 1.0 / 7.0, kOutsideShare = 1.0 / 7.0;
constexpr std::uint64_t kStream = 77;  // apart from the cases of the proof

WheelSpeedPath wheel_speeds(const DifferentialDrive& drive, const std::vector<DriveLeg>& legs) {
  WheelSpeedPath path;
  const double half_m = 0.5 * drive.wheelbase_m;
  for (const DriveLeg& leg : legs)
    path.phases.push_back({leg.duration_s, (leg.speed_mps - half_m * leg.yaw_rate_radps) / drive.wheel_radius_left_m,
                           (leg.speed_mps + half_m * leg.yaw_rate_radps) / drive.wheel_radius_right_m});
  path.ramp_s = 0.4;
  return path;
}

}  // namespace

std::optional<DrawnMystery> drawn_mystery(std::uint64_t seed, const Progress& progress) {
  if (!goes_on(progress, 0.0)) return std::nullopt;
  const std::uint64_t own = seed_of_stream(seed, kStream);
  Random random(own);
  const double kind = random.uniform();
  concealed::Wish wish;
  wish.kind = kind < kNothingShare                   ? concealed::Kind::nothing
              : kind < kNothingShare + kOutsideShare ? concealed::Kind::outside
                                                     : concealed::Kind::one;
  wish.level = random.uniform() < 0.5 ? concealed::Level::strong : concealed::Level::medium;
  wish.poor = false;
  const concealed::DrawnCase drawn = concealed::drawn_case(own, 0, wish, progress);
  if (!goes_on(progress, 1.0)) return std::nullopt;
  DrawnMystery mystery;
  mystery.seed = seed;
  mystery.nominal = drawn.robot.scenario.vehicle;
  mystery.nominal.name = "mystery robot " + std::to_string(seed);
  for (const concealed::Run& run : drawn.given) mystery.recordings.push_back(run.recording());
  mystery.kind = drawn.kind;
  if (!drawn.effects.empty()) mystery.effect = drawn.effects.front().active;
  mystery.robot.robot = drawn.robot;
  mystery.robot.effects = drawn.effects;
  return mystery;
}

std::vector<std::string> mystery_guesses() {
  std::vector<std::string> guesses{""};
  for (const std::string& name : concealed::drawable_effects()) guesses.push_back(name);
  guesses.push_back(kOutsideGuess);
  return guesses;
}

std::string right_guess(const DrawnMystery& mystery) {
  return mystery.kind == concealed::Kind::nothing   ? ""
         : mystery.kind == concealed::Kind::outside ? kOutsideGuess
                                                    : mystery.effect.effect;
}

concealed::RunPlan robot_of(const FittedModel& model, const FittedNoise& noise) {
  concealed::RunPlan plan;
  Scenario& s = plan.robot.scenario;
  s.vehicle = model.vehicle;
  s.actual = as_drawn(std::get<DifferentialDrive>(model.vehicle.kind));
  s.sensors.truth_position_noise_m = noise.truth_position_m;
  s.sensors.truth_heading_noise_rad = noise.truth_heading_rad;
  plan.robot.rolling_noise_m_per_sqrt_m = noise.wheel_m_per_sqrt_m;
  for (const FittedEffect& fitted : model.effects) {
    if (!fitted.recording.empty()) continue;
    const std::optional<ActiveEffect> active = effect_for_scenario(fitted.active, Recording{});
    if (!active) continue;
    concealed::DrawnEffect effect;
    effect.active = *active;
    plan.effects.push_back(effect);
  }
  return plan;
}

Recording advised_run(const concealed::RunPlan& robot, const std::vector<DriveLeg>& legs, const Pose& start,
                      const std::string& name, std::uint64_t seed) {
  concealed::RunPlan plan = robot;
  plan.drive = {name, wheel_speeds(plan.robot.nominal(), legs), {}, start};
  std::erase_if(plan.effects, [](const concealed::DrawnEffect& e) { return e.only_in_run >= 0; });
  plan.noise = true;
  plan.longest_s = 2.0 * AdvisedDrive{"", legs}.duration_s();
  plan.seed = seed;
  concealed::DrivenRun run = concealed::driven(plan);
  run.recording.name = name;
  return run.recording;
}

std::vector<Vec2> advised_path(const DifferentialDrive& drive, const std::vector<DriveLeg>& legs, const Pose& start) {
  constexpr double kCorner_s = 0.1;
  std::vector<Vec2> path;
  for (const TruthSample& t : run_of(AdvisedDrive{"", legs}, DrivingRange{}, drive, kCorner_s, true).truth)
    path.push_back(start * t.position);
  return path;
}

}  // namespace odolab
