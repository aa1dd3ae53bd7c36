// Of the truth there are the poses alone at which a run began and ended, once or several times over.
#include <gtest/gtest.h>

#include <algorithm>
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

// Squares of 1.8 m that end where they began, clockwise and counter-clockwise: places measured by tape.
std::vector<Recording> squares_by_tape(const test::GeneratorSettings& g, Random& random) {
  constexpr int kSquares = 10;
  constexpr double kSide_s = 7.0, kCorner_s = 4.0, kRamp_s = 0.5;
  const double turning_radps =
      0.25 * kPi * g.drive.wheelbase_m / (g.drive.wheel_radius_left_m * (kCorner_s - 2.0 * kRamp_s));
  const double faster = g.drive.wheel_radius_left_m / g.drive.wheel_radius_right_m;
  std::vector<Recording> squares;
  for (int k = 0; k < kSquares; ++k) {
    const double left = k % 2 == 0 ? turning_radps : -turning_radps;
    squares.push_back(generated(
        g,
        [&](double time_s) {
          const double at_s = std::fmod(time_s, kSide_s + kCorner_s);
          const auto ramp = [&](double from_s, double to_s) {
            return std::clamp(std::min(at_s - from_s, to_s - at_s) / kRamp_s, 0.0, 1.0);
          };
          const double way = 4.0 * ramp(0.0, kSide_s), turn = left * ramp(kSide_s + kRamp_s, kSide_s + kCorner_s);
          return test::WheelSpeedsAt{way - turn, faster * (way + turn)};
        },
        random));
  }
  return squares;
}

// Laid onto what noise makes of their return, squares that close would all seem to miss it by as much.
TEST(PosesAtBothEnds, OfSquaresThatCloseSayNoMoreThanTheirNoiseLetsThem) {
  constexpr int kSets = 20;
  constexpr double kMost = 2.0;  // 1.0 but for chance and for how badly twenty numbers tell their noise; 9 if laid so
  test::GeneratorSettings g;
  g.drive.wheel_radius_left_m *= 1.005;
  g.drive.wheelbase_m *= 1.015;
  g.duration_s = 44.0;
  g.truth_period_s = 0.0;
  g.truth_has_heading = false;
  g.truth_position_noise_m = 0.005;
  g.wheel_noise = 3e-4;
  g.step_s = 0.002;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < kSets; ++seed) {
    Random random(300 + seed);
    const auto fit = calibrate_least_squares(squares_by_tape(g, random), Vehicle{});
    ASSERT_TRUE(fit.ok());
    double base_m = 0.0, base_stderr_m = 0.0, radius_m = 0.0;
    for (const ParameterEstimate& p : fit->parameters) {
      if (p.name == "wheelbase_m") base_m = p.value, base_stderr_m = p.determined ? p.stderr_value : 0.0;
      if (p.name.rfind("wheel_radius", 0) == 0) radius_m += 0.5 * p.value;
    }
    ASSERT_GT(base_stderr_m, 0.0) << seed;
    const double actual_radius_m = 0.5 * (g.drive.wheel_radius_left_m + g.drive.wheel_radius_right_m);
    squares += std::pow((base_m * actual_radius_m / radius_m - g.drive.wheelbase_m) / base_stderr_m, 2);
  }
  EXPECT_LT(squares, kMost * kSets);
}

}  // namespace
}  // namespace odolab
