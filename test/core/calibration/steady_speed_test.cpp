// A truth without headings, of robots that always drive at the same speed: a clock that is late by dt then looks like a
// tracked point that is v dt further behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/calibration/least_squares.h"
#include "test/support/drive_generator.h"

namespace odolab {
namespace {

constexpr double kSteady_radps = 4.0;  // of both wheels: 0.3 m/s
constexpr double kTurn_radps = 1.0;    // less of one and more of the other

// As one marker is seen, late and ahead of an axle that is wider than drawn.
test::GeneratorSettings seen_by_a_marker() {
  test::GeneratorSettings g;
  g.drive.wheelbase_m *= 1.02;
  g.drive.wheel_radius_right_m *= 0.99;
  g.truth.axle_T_tracked = {0.1, 0.02, 0.0};
  g.truth.time_offset_s = 0.06;
  g.truth_has_heading = false;
  g.truth_position_noise_m = 0.002;
  g.wheel_noise = 3e-4;
  g.step_s = 0.002;
  g.duration_s = 80.0;
  return g;
}

const ParameterEstimate& estimate_of(const LeastSquaresCalibration& c, const std::string& name) {
  for (const ParameterEstimate& p : c.parameters)
    if (p.name == name) return p;
  static const ParameterEstimate none{};
  ADD_FAILURE() << "no parameter " << name;
  return none;
}

// To that standard error, and true within 3.5 standard errors: one in 2000 is further off.
void expect_known(const LeastSquaresCalibration& c, const std::string& name, double size, double stderr_most) {
  const ParameterEstimate& p = estimate_of(c, name);
  EXPECT_TRUE(p.determined) << name;
  EXPECT_LT(p.stderr_value, stderr_most) << name;
  EXPECT_NEAR(p.value, size, 3.5 * p.stderr_value) << name;
}

void expect_known_drive(const LeastSquaresCalibration& c, const DifferentialDrive& drive, double share) {
  expect_known(c, "wheelbase_m", drive.wheelbase_m, share * drive.wheelbase_m);
  expect_known(c, "wheel_radius_left_m", drive.wheel_radius_left_m, share * drive.wheel_radius_left_m);
  expect_known(c, "wheel_radius_right_m", drive.wheel_radius_right_m, share * drive.wheel_radius_right_m);
}

// Ten seconds of lane, then a turn on the spot.
test::WheelSpeedsAt lanes_with_turns_on_the_spot(double time_s) {
  const double at_s = std::fmod(time_s, 16.0);
  const double ramp = std::clamp(std::min(at_s, 10.0 - at_s) / 0.8, 0.0, 1.0);
  const double turn = std::clamp(std::min(at_s - 11.0, 15.0 - at_s) / 0.4, 0.0, 1.0);
  return {kSteady_radps * ramp - kTurn_radps * turn, kSteady_radps * ramp + kTurn_radps * turn};
}

// Circles to the left and to the right, and never a stop.
test::WheelSpeedsAt eights_without_a_stop(double time_s) {
  const double turn = kTurn_radps * std::tanh(5.0 * std::sin(2.0 * kPi * time_s / 27.0));
  return {kSteady_radps - turn, kSteady_radps + turn};
}

TEST(SteadySpeed, TellsMarkerAndClockApartWhereTheRobotStopsNowAndThen) {
  const test::GeneratorSettings g = seen_by_a_marker();
  for (std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    const auto fit = calibrate_least_squares({generated(g, lanes_with_turns_on_the_spot, random)}, Vehicle{});
    ASSERT_TRUE(fit.ok());
    expect_known_drive(*fit, g.drive, 0.001);
    expect_known(*fit, "truth_mounting.x_m", g.truth.axle_T_tracked.x_m, 0.001);
    expect_known(*fit, "truth_mounting.time_offset_s", g.truth.time_offset_s, 0.002);
    EXPECT_LT(fit->noise.wheel_m_per_sqrt_m, 3.0 * g.wheel_noise);
  }
}

TEST(SteadySpeed, BendsNeitherWheelbaseNorNoiseWhereALateClockLooksLikeAMarkerFurtherBehind) {
  test::GeneratorSettings g = seen_by_a_marker();
  g.truth_position_noise_m = 0.02;  // in which what differs where a turn begins does not show
  g.truth_period_s = 0.2;
  for (std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    const auto fit = calibrate_least_squares({generated(g, eights_without_a_stop, random)}, Vehicle{});
    ASSERT_TRUE(fit.ok());
    expect_known_drive(*fit, g.drive, 0.002);
    EXPECT_LT(fit->noise.wheel_m_per_sqrt_m, 3.0 * g.wheel_noise);
    const ParameterEstimate& x = estimate_of(*fit, "truth_mounting.x_m");
    const ParameterEstimate& clock = estimate_of(*fit, "truth_mounting.time_offset_s");
    EXPECT_GT(x.stderr_value, 0.005);  // each by itself is known as well as clocks are
    EXPECT_GT(clock.stderr_value, 0.02);
    EXPECT_NEAR(x.value, g.truth.axle_T_tracked.x_m, 3.5 * x.stderr_value);
    const double speed_mps = kSteady_radps * g.drive.wheel_radius_left_m;
    EXPECT_NEAR(x.value - speed_mps * clock.value, g.truth.axle_T_tracked.x_m - speed_mps * g.truth.time_offset_s,
                0.01);
    EXPECT_TRUE(std::any_of(fit->cannot_tell.begin(), fit->cannot_tell.end(), [](const std::string& s) {
      return s.find("a late clock looks like") != std::string::npos;
    }));
  }
}

}  // namespace
}  // namespace odolab
