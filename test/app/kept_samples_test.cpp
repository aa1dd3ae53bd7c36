#include "app/gui/kept_samples.h"

#include <gtest/gtest.h>

#include "app/gui/drive_run.h"
#include "test/support/same_bits.h"

namespace odolab {
namespace {

// A steady circle for so long; commands, and a truth with a clock of its own.
Scenario circle(double duration_s) {
  Scenario scenario;
  WheelSpeedPath path;
  path.phases = {{duration_s, 3.0, 4.0}};
  scenario.path = path;
  scenario.sensors.record_commands = true;
  scenario.sensors.truth_period_s = 0.05;
  scenario.vehicle.truth.time_offset_s = 0.013;
  scenario.step_s = 0.005;
  return scenario;
}

TEST(KeptSamples, OfARunOfMinutesMakeTheRecordingOfAHeadlessRunToTheBit) {
  const Scenario scenario = circle(170.0);
  Simulation headless(scenario, scenario.seed);
  run_to_end(headless);
  DriveRun run(scenario);
  run.advance(1e6, [] { return true; });
  ASSERT_TRUE(run.finished());
  expect_same_bits(*run.recording(), headless.recording());
  // 8500 samples, of which 2 times 3000 were put away; a sample has a row, a truth between two samples another.
  EXPECT_LT(run.simulation().recording().time_s.size(), headless.recording().time_s.size() / 2);
}

TEST(KeptSamples, BeginAnewWithTheRun) {
  const Scenario scenario = circle(70.0);
  DriveRun run(scenario);
  run.advance(65.0, [] { return true; });
  run.restart();
  run.advance(1e6, [] { return true; });
  Simulation headless(scenario, scenario.seed);
  run_to_end(headless);
  expect_same_bits(*run.recording(), headless.recording());
}

TEST(TemporaryNumbers, ComeBackInOrderHoweverOftenTheyAreRead) {
  TemporaryNumbers numbers;
  EXPECT_TRUE(numbers.all()->empty());
  numbers.append({1.0, -0.0});
  EXPECT_EQ(numbers.all()->size(), 2u);
  numbers.append({1e-300});
  EXPECT_EQ(*numbers.all(), (std::vector<double>{1.0, -0.0, 1e-300}));
  EXPECT_EQ(numbers.size(), 3u);
}

}  // namespace
}  // namespace odolab
