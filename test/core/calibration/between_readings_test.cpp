#include "core/calibration/between_readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

constexpr double kRead_s = 0.2, kSeen_s = 0.02, kNoise_m = 0.0005;

// Straight on for twelve seconds, read five times a second, and seen fifty times.
InnovationRun read_slowly(double (*rolled_rad)(double time_s)) {
  Random random(4);
  InnovationRun run;
  for (int i = 0; i <= 60; ++i) run.wheels.push_back({kRead_s * i, rolled_rad(kRead_s * i), rolled_rad(kRead_s * i)});
  for (int k = 0; k <= 600; ++k)
    run.truth.push_back({kSeen_s * k,
                         {0.1 * rolled_rad(kSeen_s * k) + kNoise_m * random.normal(), kNoise_m * random.normal()},
                         0.001 * random.normal()});
  run.truth_has_heading = true;
  return run;
}

InnovationModel of_that_noise() {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, kNoise_m, 0.001};
  return model;
}

TEST(BetweenReadings, SaysAsMuchAsAtThemWhileTheWheelsTurnEvenly) {
  InnovationRun run = read_slowly([](double t) { return 3.0 * t; });
  trust_less_between_readings(run, of_that_noise());
  for (const double times : run.truth_variance) EXPECT_NEAR(times, 1.0, 1e-9);
}

// From rest to 3 rad/s, at once, between two readings: what a cubic makes of that is off by millimetres.
TEST(BetweenReadings, SaysLessWhereTheWheelsSpeedUp) {
  constexpr double kSetsOff_s = 6.1;
  InnovationRun run = read_slowly([](double t) { return t > kSetsOff_s ? 3.0 * (t - kSetsOff_s) : 0.0; });
  trust_less_between_readings(run, of_that_noise());
  for (std::size_t k = 0; k < run.truth.size(); ++k) {
    const double at_s = run.truth[k].time_s;
    const bool is_read = k % 10 == 0;
    if (is_read || std::abs(at_s - kSetsOff_s) > 4.0 * kRead_s) {
      EXPECT_NEAR(run.truth_variance[k], 1.0, 1e-6) << at_s;
    }
  }
  EXPECT_GT(run.truth_variance[305], 10.0);  // halfway between the readings about it
}

TEST(BetweenReadings, SaysAsMuchAsAtThemWhereTheyAreCloseTogether) {
  InnovationRun run = read_slowly([](double t) { return t > 6.1 ? 3.0 * (t - 6.1) : 0.0; });
  for (WheelSample& w : run.wheels) w.time_s *= 0.1;
  for (TruthSample& t : run.truth) t.time_s *= 0.1;
  trust_less_between_readings(run, of_that_noise());
  EXPECT_TRUE(run.truth_variance.empty());
}

}  // namespace
}  // namespace odolab
