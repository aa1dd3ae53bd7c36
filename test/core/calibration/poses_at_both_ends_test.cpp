// Of the truth there are the poses alone at which a run began and ended, once or several times over.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/calibration/least_squares.h"
#include "test/support/drive_generator.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

constexpr double kRest_s = 0.6;

// Runs at rest where they begin and end, by so many poses there that err by two millimetres and milliradians.
struct Ends {
  test::GeneratorSettings settings;
  std::vector<Recording> runs;
};

Ends measured_ends(int runs, int poses, std::uint64_t seed) {
  Ends ends;
  test::GeneratorSettings& g = ends.settings;
  g.drive.wheel_radius_left_m *= 1.005;
  g.drive.wheelbase_m *= 0.98;
  g.truth.axle_T_tracked = {0.02, -0.015, 0.02};
  g.truth_period_s = 0.1;
  g.wheel_noise = 1e-4;
  g.truth_position_noise_m = g.truth_heading_noise_rad = 0.002;
  g.step_s = 0.002;
  Random random(seed);
  for (int run = 0; run < runs; ++run) {
    g.duration_s = 30.0;
    const test::SpeedProfile drive = test::varied_driving(random, g.duration_s - 2.0 * kRest_s);
    const test::SpeedProfile rests = [&](double time_s) {
      const double at_s = time_s - kRest_s;
      return at_s < 0.0 || at_s > g.duration_s - 2.0 * kRest_s ? test::WheelSpeedsAt{} : drive(at_s);
    };
    Recording r = generated(g, rests, random);
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < r.time_s.size(); ++i)
      if (!std::isnan(r.channel("truth_x_m")->values[i])) rows.push_back(i);
    for (Channel& c : r.channels)
      for (std::size_t k = static_cast<std::size_t>(poses); k + static_cast<std::size_t>(poses) < rows.size(); ++k)
        if (c.name.rfind("truth_", 0) == 0) c.values[rows[k]] = std::numeric_limits<double>::quiet_NaN();
    ends.runs.push_back(std::move(r));
  }
  return ends;
}

// Ten of a run say little of how white their noise is.
TEST(PosesAtBothEnds, AreAllUsedWhereTheirNoiseIsWhite) {
  constexpr int kSets = 10;
  int all_used = 0;
  for (std::uint64_t seed = 0; seed < kSets; ++seed) {
    const auto fit = calibrate_least_squares(measured_ends(6, 5, 100 + seed).runs, Vehicle{});
    ASSERT_TRUE(fit.ok());
    all_used += fit->truth_apart_s == 0.0;
  }
  EXPECT_GE(all_used, 8);  // of three numbers each one in eighty is more than chance
}

// Four ways say twelve numbers of eight: how much the poses err they hardly say by themselves.
TEST(PosesAtBothEnds, AreNotTakenForTruerThanSuchPosesAre) {
  constexpr int kSets = 60;
  constexpr double kMost = 1.35;  // 1.0 but for chance, four numbers of one set going together; 1.8 by themselves
  double squares = 0.0;
  int numbers = 0;
  for (std::uint64_t seed = 0; seed < kSets; ++seed) {
    const Ends ends = measured_ends(4, 1, 200 + seed);
    const auto fit = calibrate_least_squares(ends.runs, Vehicle{});
    ASSERT_TRUE(fit.ok());
    const test::GeneratorSettings& actual = ends.settings;
    const std::pair<const char*, double> sizes[] = {{"truth_mounting.x_m", actual.truth.axle_T_tracked.x_m},
                                                    {"truth_mounting.y_m", actual.truth.axle_T_tracked.y_m},
                                                    {"wheelbase_m", actual.drive.wheelbase_m},
                                                    {"wheel_radius_left_m", actual.drive.wheel_radius_left_m}};
    for (const ParameterEstimate& p : fit->parameters)
      for (const auto& [name, size] : sizes) {
        if (p.name != name || !p.determined) continue;
        squares += std::pow((p.value - size) / p.stderr_value, 2);
        ++numbers;
      }
  }
  EXPECT_GT(numbers, 3 * kSets);
  EXPECT_LT(squares, kMost * numbers);
}

}  // namespace
}  // namespace odolab
