#include "core/calibration/fewer_readings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

// Each wheel speeds up evenly for ten seconds, read at 100 Hz; none are lost but for 0.3 s.
InnovationRun run_speeding_up() {
  InnovationRun run;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    if (t > 5.001 && t < 5.299) continue;
    run.wheels.push_back({t, 0.5 * t * t, 1.5 * t * t});
  }
  run.smooth = run.wheels;
  run.accelerations.assign(run.wheels.size() - 1, {1.0, 3.0, 1.0, 3.0});
  run.settles.assign(run.wheels.size() - 1, 0);
  run.settles[10] = 1;
  run.settles[11] = 2;
  return run;
}

TEST(FewerReadings, AreNoFurtherApartThanAskedForButWhereTheyWere) {
  const InnovationRun few = with_fewer_readings(run_speeding_up(), 0.034);
  EXPECT_EQ(few.wheels.front().time_s, 0.0);
  EXPECT_EQ(few.wheels.back().time_s, 10.0);
  int longer = 0;
  for (std::size_t i = 1; i < few.wheels.size(); ++i) longer += few.wheels[i].time_s - few.wheels[i - 1].time_s > 0.034;
  EXPECT_EQ(longer, 1);
  EXPECT_NEAR(static_cast<double>(few.wheels.size()), 1.0 + 970.0 / 3.0, 2.0);
}

TEST(FewerReadings, AreThoseThatWere) {
  const InnovationRun few = with_fewer_readings(run_speeding_up(), 0.034);
  for (const WheelSample& w : few.wheels) {
    EXPECT_EQ(w.left_rad, 0.5 * w.time_s * w.time_s);
    EXPECT_EQ(w.right_rad, 1.5 * w.time_s * w.time_s);
  }
  EXPECT_EQ(few.smooth.size(), few.wheels.size());
  EXPECT_EQ(few.accelerations.size(), few.wheels.size() - 1);
  constexpr double kRounding = 1e-9;
  for (const WheelAcceleration& a : few.accelerations) {
    EXPECT_NEAR(a.left_radps2, 1.0, kRounding);
    EXPECT_NEAR(a.right_steady_radps2, 3.0, kRounding);
  }
}

TEST(FewerReadings, KeepWhereAWheelComesToRest) {
  const InnovationRun few = with_fewer_readings(run_speeding_up(), 0.034);
  unsigned settles = 0;
  for (std::size_t i = 0; i < few.settles.size(); ++i)
    if (few.settles[i]) {
      settles |= few.settles[i];
      EXPECT_NEAR(few.wheels[i].time_s, 0.11, 0.03);
    }
  EXPECT_EQ(settles, 3u);
}

TEST(FewerReadings, KeepBothEndsOfWhatIsLeftOut) {
  InnovationRun run = run_speeding_up();
  run.left_out = {{run.wheels[101].time_s, run.wheels[102].time_s}};
  const InnovationRun few = with_fewer_readings(run, 0.034);
  for (const std::size_t k : {101u, 102u})
    EXPECT_EQ(std::count_if(few.wheels.begin(), few.wheels.end(),
                            [&](const WheelSample& w) { return w.time_s == run.wheels[k].time_s; }),
              1);
}

TEST(FewerReadings, AreNotTakenOfCommands) {
  InnovationRun run = run_speeding_up();
  run.speeds_are_held = true;
  EXPECT_EQ(with_fewer_readings(run, 0.034).wheels.size(), run.wheels.size());
}

}  // namespace
}  // namespace odolab
