// What acts on the truck of a CLAPPER whose place the link tells: that it is what was asked for, and that it is found.
#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/recording/vehicle_samples.h"
#include "physics/simulation.h"

namespace odolab::test {
namespace {

Scenario clapper_on(const Path& path, double speed_mps, const std::vector<ActiveEffect>& effects) {
  Scenario s;
  s.vehicle.kind = Clapper{};
  s.path = path;
  s.effects = effects;
  s.driving = {speed_mps, 0.4, 0.2, 0.3, 2.0};
  s.sensors.truth_period_s = 0.02;
  s.sensors.truth_position_noise_m = 0.001;
  s.sensors.truth_heading_noise_rad = 0.002;
  s.floor.roughness = {0.0003, 0.02};
  s.step_s = 0.004;
  return s;
}

Recording driven_clapper(const Scenario& scenario, std::uint64_t seed) {
  Simulation simulation(scenario, seed);
  run_to_end(simulation, 200.0);
  Recording recording = simulation.recording();
  recording.name = "run_" + std::to_string(seed);
  return recording;
}

Diagnosis diagnosed(const ActiveEffect& effect, std::uint64_t seed) {
  std::vector<Recording> runs = {driven_clapper(clapper_on(FigureEightPath{1.2, 1}, 0.35, {effect}), seed),
                                 driven_clapper(clapper_on(SquarePath{2.0}, 0.25, {effect}), seed + 1),
                                 driven_clapper(clapper_on(RectanglePath{4.0, 3.0, 0.48}, 0.3, {effect}), seed + 2)};
  const Result<Diagnosis> d = diagnose(runs, {}, clapper_on(SquarePath{}, 0.3, {}).vehicle);
  EXPECT_TRUE(d);
  return d ? *d : Diagnosis{};
}

void expect_alone(const Diagnosis& d, const ActiveEffect& effect, double within_share) {
  std::string said;
  for (const Finding& f : d.findings) said += f.effect + " of " + f.component + "; ";
  ASSERT_EQ(d.findings.size(), 1u) << said;
  EXPECT_EQ(d.findings[0].effect, effect.effect);
  EXPECT_EQ(d.findings[0].component, effect.component);
  const FoundParameter& size = d.findings[0].parameters[0];
  const double there = effect.parameter(size.name);
  EXPECT_NEAR(size.value, there, within_share * there) << size.name;
  EXPECT_NEAR(size.value, there, 3.0 * size.stderr_value) << size.name;
}

// Held by the link or not: half seconds of its way against what its wheels rolled.
TEST(EffectsOnATruck, TakeOfItsWayWhatTheySay) {
  constexpr double kLoss = 0.1;
  Scenario s = clapper_on(FigureEightPath{1.2, 1}, 0.35, {{"turn_speed_loss", "truck_b", {{"per_radps", kLoss}}}});
  auto& trucks = std::get<Clapper>(s.vehicle.kind);
  trucks.link_angle_resolution_rad = trucks.link_length_resolution_m = 0.0;
  s.sensors.truth_position_noise_m = s.sensors.truth_heading_noise_rad = 0.0;
  s.floor.roughness = {};  // over which wheels roll further than they go
  const Recording recording = driven_clapper(s, 11);
  const std::vector<LinkedSample> samples = linked_samples(recording);
  const Track a = truth_track(recording);
  const auto b_at = [&](const LinkedSample& l) {
    return *pose_at(a, l.time_s) * Pose{0.0, 0.0, -l.link_angle_a_rad} *
           Pose{-l.link_length_m, 0.0, l.link_angle_b_rad};
  };
  const DifferentialDrive& drive = trucks.truck_b;
  constexpr std::size_t kHalfSecond = 25;
  double products = 0.0, squares = 0.0;
  for (std::size_t i = kHalfSecond; i < samples.size(); i += kHalfSecond) {
    double rolled_m = 0.0, lost_m = 0.0, went_m = 0.0;
    for (std::size_t k = i - kHalfSecond; k < i; ++k) {
      const LinkedSample &from = samples[k], &to = samples[k + 1];
      const double left_m = drive.wheel_radius_left_m * (to.b.left_rad - from.b.left_rad),
                   right_m = drive.wheel_radius_right_m * (to.b.right_rad - from.b.right_rad);
      const Pose step = between(b_at(from), b_at(to));
      rolled_m += 0.5 * (left_m + right_m);
      lost_m += 0.5 * (left_m + right_m) * std::abs(step.heading_rad) / (to.time_s - from.time_s);
      went_m += step.x_m;
    }
    products += lost_m * (rolled_m - went_m);
    squares += lost_m * lost_m;
  }
  EXPECT_NEAR(products / squares, kLoss, 0.01 * kLoss);
}

// A link that is taken to be 17 mm shorter throws truck B by 0.03 of it as it turns: the geometry, which is fitted
// before anything is named, must not keep that.
TEST(EffectsOnATruck, AreNotTakenForALinkThatIsShorter) {
  const ActiveEffect loss{"turn_speed_loss", "truck_b", {{"per_radps", 0.1}}};
  expect_alone(diagnosed(loss, 21), loss, 0.03);
}

TEST(EffectsOnATruck, AreNotTakenForALinkThatIsReadTurned) {
  const ActiveEffect slip{"lateral_slip", "truck_b", {{"m_per_s_per_mps2", 0.1}}};
  expect_alone(diagnosed(slip, 31), slip, 0.05);
}

// Of what is small it takes a quarter, and from the recordings of other seeds all.
TEST(EffectsOnATruck, AreNamedWhereALinkThatIsShorterWouldSayThemAll) {
  const ActiveEffect loss{"turn_speed_loss", "truck_b", {{"per_radps", 0.02}}};
  expect_alone(diagnosed(loss, 41), loss, 0.1);
}

// An axle that is off by a hundredth swings truck B by 2.2 mrad to either side, which a link that is held in steps of
// 5.2 reads as nothing: the truck's own truth has a seventh less of it.
TEST(EffectsOnATruck, AreAsLargeAsAllUnitsTellWhereTheLinkRoundsThem) {
  const ActiveEffect oval{"wheel_eccentricity", "truck_b.left_wheel", {{"amplitude", 0.01}, {"phase_rad", 0.5}}};
  expect_alone(diagnosed(oval, 51), oval, 0.05);
}

}  // namespace
}  // namespace odolab::test
