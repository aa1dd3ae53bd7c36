#include "core/calibration/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "test/support/drive_generator.h"

namespace odolab {
namespace {

using test::GeneratorSettings;

// A LabMate whose machine differs from its drawing: radii by 2 %, wheelbase by 5 %, tracked point off the axle's centre.
GeneratorSettings off_the_drawing() {
  GeneratorSettings g;
  g.drive.wheel_radius_left_m = 0.075 * 1.02;
  g.drive.wheel_radius_right_m = 0.075 * 1.015;
  g.drive.wheelbase_m = 0.340 * 1.05;
  g.truth.axle_T_tracked = {0.05, -0.03, 0.04};
  g.truth.time_offset_s = 0.03;
  g.wheel_noise = 0.003;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.003;
  return g;
}

std::map<std::string, double> true_values(const GeneratorSettings& g) {
  return {{"wheel_radius_left_m", g.drive.wheel_radius_left_m},
          {"wheel_radius_right_m", g.drive.wheel_radius_right_m},
          {"wheelbase_m", g.drive.wheelbase_m},
          {"truth_mounting.x_m", g.truth.axle_T_tracked.x_m},
          {"truth_mounting.y_m", g.truth.axle_T_tracked.y_m},
          {"truth_mounting.heading_rad", g.truth.axle_T_tracked.heading_rad},
          {"truth_mounting.time_offset_s", g.truth.time_offset_s}};
}

Vehicle labmate() { return Vehicle{"LabMate", DifferentialDrive{}, {}}; }

const ParameterEstimate& named(const LeastSquaresCalibration& c, const std::string& name) {
  for (const ParameterEstimate& p : c.parameters)
    if (p.name == name) return p;
  static const ParameterEstimate none{};
  ADD_FAILURE() << "no parameter " << name;
  return none;
}

bool says(const std::vector<std::string>& sentences, const std::string& words) {
  for (const std::string& s : sentences)
    if (s.find(words) != std::string::npos) return true;
  return false;
}

// Counts how often each claimed interval holds its true value.
struct Coverage {
  std::map<std::string, int> held;
  std::map<std::string, double> squares;
  int runs = 0;

  void add(const LeastSquaresCalibration& c, const std::map<std::string, double>& truth) {
    ++runs;
    for (const ParameterEstimate& p : c.parameters) {
      if (!p.determined) continue;
      const double z = (p.value - truth.at(p.name)) / p.stderr_value;
      held[p.name] += std::abs(z) < 1.96;
      squares[p.name] += z * z;
    }
  }
  // With 200 runs at 95 % the number held has a standard deviation of sqrt(200 * 0.95 * 0.05) = 3.1 runs or 1.5 %: 90 to
  // 99 % is three of them, on either side.
  void expect_honest(const std::string& name) {
    const double share = static_cast<double>(held[name]) / runs;
    EXPECT_GE(share, 0.90) << name;
    EXPECT_LE(share, 0.99) << name;
    std::printf("%-30s %5.1f %%  z rms %.3f\n", name.c_str(), 100.0 * share, std::sqrt(squares[name] / runs));
  }
};

TEST(LeastSquares, RecoversRadiiWrongByTwoPercentAndWheelbaseByFive) {
  Random random(1);
  const GeneratorSettings g = off_the_drawing();
  const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
  ASSERT_TRUE(result.ok()) << result.error().message();
  for (const auto& [name, value] : true_values(g)) {
    const ParameterEstimate& p = named(*result, name);
    EXPECT_TRUE(p.determined) << name;
    EXPECT_NEAR(p.value, value, 4.0 * p.stderr_value) << name;  // four standard errors: 6e-5 by chance
    std::printf("%-30s %.6f true %.6f +- %.2g\n", name.c_str(), p.value, value, p.stderr_value);
  }
  EXPECT_TRUE(result->cannot_tell.empty());
  EXPECT_GT(result->normalised_chi2_nominal, 2.0);
  EXPECT_NEAR(result->normalised_chi2, 1.0, 0.1);  // 1800 innovations: their mean square scatters by 3 %
  EXPECT_NEAR(result->noise.truth_position_m, 0.001, 0.0002);
  EXPECT_NEAR(result->noise.wheel_m_per_sqrt_m, 0.003, 0.0008);
  std::printf("noise q %.5f xy %.5f h %.5f corr %.3f %.3f %.3f\n", result->noise.wheel_m_per_sqrt_m, result->noise.truth_position_m,
              result->noise.truth_heading_rad, result->correlation[0], result->correlation[1], result->correlation[2]);
}

TEST(LeastSquares, ClaimsIntervalsThatHoldInRichDriving) {
  Coverage coverage;
  for (int i = 0; i < 200; ++i) {
    Random random(seed_of_stream(7, i));
    GeneratorSettings g = off_the_drawing();
    const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
    ASSERT_TRUE(result.ok());
    coverage.add(*result, true_values(g));
  }
  for (const auto& [name, value] : true_values(off_the_drawing())) coverage.expect_honest(name);
}

TEST(LeastSquares, ClaimsIntervalsThatHoldWithTruthAtStartAndEndOnly) {
  Coverage coverage;
  for (int i = 0; i < 200; ++i) {
    Random random(seed_of_stream(8, i));
    GeneratorSettings g = off_the_drawing();
    g.truth = {};
    g.truth_period_s = 0.0;
    g.truth_position_noise_m = 0.002;  // the sonar corner of the UMBmark report
    g.truth_heading_noise_rad = 0.007;
    g.wheel_period_s = 0.1;
    g.step_s = 0.004;
    std::vector<Recording> runs;
    for (int k = 0; k < 10; ++k) {
      const auto profile = test::square_driving(DifferentialDrive{}, 2.0, k % 2 == 0, &g.duration_s);
      runs.push_back(generated(g, profile, random));
    }
    // A tape measure's straight gives the scale, which a closed path hides.
    g.duration_s = 10.0;
    for (int k = 0; k < 2; ++k)
      runs.push_back(generated(g, [](double t) { const double v = 8.0 * std::pow(std::sin(kPi * t / 10.0), 2); return test::WheelSpeedsAt{v, v}; }, random));
    const auto result = calibrate_least_squares(runs, labmate());
    ASSERT_TRUE(result.ok());
    coverage.add(*result, true_values(g));
    EXPECT_FALSE(named(*result, "truth_mounting.time_offset_s").determined);
  }
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"}) coverage.expect_honest(name);
}

}  // namespace
}  // namespace odolab
