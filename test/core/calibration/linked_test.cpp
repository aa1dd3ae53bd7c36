#include "core/calibration/linked.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/kinematics/trucks.h"

namespace odolab {
namespace {

Clapper clapper() {
  Clapper v;
  v.link_angle_resolution_rad = radians(0.3);
  return v;
}

// Angles that both trucks are to have to the link, and the speed of A, for a time.
struct Phase {
  double alpha_rad, beta_rad, speed_mps, duration_s;
};

// Truck A and B steer to their angles, B keeps the link's length.
Recording driven_by_phases(const LinkedTrucks& actual, const std::vector<Phase>& phases, std::uint64_t seed) {
  LinkedKinematics v(actual, {}, 0.0, 0.0, actual.link_length_m);
  std::vector<LinkedSample> samples{rounded(v.reading(), actual, seed)};
  double wobble = 0.0;
  for (const Phase& phase : phases)
    for (int i = 0; i < static_cast<int>(phase.duration_s / 0.04); ++i) {
      for (int k = 0; k < 10; ++k) {
        wobble += 0.004;  // controllers are never quite still: half a degree, so that the encoders' steps are passed
        const double alpha = wrapped(v.a().heading_rad - v.link_heading_rad());
        const double beta = wrapped(v.b().heading_rad - v.link_heading_rad());
        const double speed_b = (phase.speed_mps * std::cos(alpha) + v.link_length_m() - actual.link_length_m) /
                               std::max(0.2, std::cos(beta));
        const double link_radps = (phase.speed_mps * std::sin(alpha) - speed_b * std::sin(beta)) / v.link_length_m();
        v.move({phase.speed_mps, link_radps + 2.0 * (phase.alpha_rad - alpha + 0.01 * std::sin(3.0 * wobble))},
               {speed_b, link_radps + 2.0 * (phase.beta_rad - beta + 0.01 * std::sin(2.0 * wobble))}, 0.004);
      }
      samples.push_back(rounded(v.reading(), actual, seed));
    }
  Recording recording = recording_of(samples);
  recording.name = "run " + std::to_string(seed);
  return recording;
}

std::vector<Phase> straights_and_turns() {
  std::vector<Phase> phases;
  for (int i = 0; i < 3; ++i)
    for (const Phase& p : {Phase{0.0, 0.0, 0.45, 10.0}, Phase{0.4, -0.4, 0.45, 10.0}, Phase{0.0, 0.0, 0.45, 10.0},
                           Phase{-0.4, 0.4, 0.45, 10.0}})
      phases.push_back(p);
  return phases;
}

std::vector<Phase> with_crabbing() {
  std::vector<Phase> phases = straights_and_turns();
  for (int i = 0; i < 2; ++i)
    for (double angle : {0.9, -0.9}) phases.push_back({angle, angle, 0.45, 10.0});
  return phases;
}

const ParameterEstimate& linked_parameter(const InternalCalibration& c, const std::string& name) {
  for (const ParameterEstimate& p : c.parameters)
    if (p.name == name) return p;
  ADD_FAILURE() << name;
  return c.parameters.front();
}

// Within four of its own standard errors, and those no larger than asked.
void expect_found(const InternalCalibration& c, const std::string& name, double should, double largest_stderr) {
  const ParameterEstimate& p = linked_parameter(c, name);
  EXPECT_TRUE(p.determined) << name;
  EXPECT_NEAR(p.value, should, 4.0 * p.stderr_value) << name;
  EXPECT_LT(p.stderr_value, largest_stderr) << name;
}

// Self-calibration of both trucks: unequal wheels and wrong wheelbases, the link's encoders unbiased.
TEST(LinkedCalibration, FindsUnequalWheelsAndWheelbasesOfBothTrucks) {
  Clapper actual = clapper();
  actual.truck_a.wheelbase_m = 0.337;
  actual.truck_a.wheel_radius_left_m = 0.075 * 0.999;
  actual.truck_a.wheel_radius_right_m = 0.075 * 1.001;
  actual.truck_b.wheelbase_m = 0.344;
  actual.truck_b.wheel_radius_left_m = 0.0755;
  Vehicle nominal;
  nominal.kind = clapper();
  const Result<InternalCalibration> found = calibrate_linked(
      {driven_by_phases(actual, straights_and_turns(), 1), driven_by_phases(actual, straights_and_turns(), 2)},
      nominal);
  ASSERT_TRUE(found) << found.error().message();
  expect_found(*found, "truck_a.wheel_radius_left_m", 0.075 * 0.999, 6e-5);
  expect_found(*found, "truck_a.wheel_radius_right_m", 0.075 * 1.001, 6e-5);
  expect_found(*found, "truck_a.wheelbase_m", 0.337, 1e-3);
  expect_found(*found, "truck_b.wheel_radius_left_m", 0.0755, 1e-4);
  expect_found(*found, "truck_b.wheelbase_m", 0.344, 1e-3);
}

TEST(LinkedCalibration, FindsTheLinkLengthsBiasInTurns) {
  Clapper actual = clapper();
  actual.link_length_offset_m = 0.002;  // what the paper suspects
  Vehicle nominal;
  nominal.kind = clapper();
  std::vector<Phase> tight = straights_and_turns();  // a radius of 0.6 m beside one of 1.2 m: the wheelbases turn alike
  for (int i = 0; i < 3; ++i)
    for (double angle : {0.7, -0.7}) tight.push_back({angle, -angle, 0.45, 15.0});
  const Result<InternalCalibration> found =
      calibrate_linked({driven_by_phases(actual, tight, 3), driven_by_phases(actual, tight, 4)}, nominal);
  ASSERT_TRUE(found) << found.error().message();
  expect_found(*found, "link_length_offset_m", 0.002, 1.5e-3);
}

TEST(LinkedCalibration, TellsBiasedEncodersFromUnequalWheelsOnlyByDrivingSideways) {
  Clapper actual = clapper();
  actual.link_angle_a_offset_rad = radians(1.0);
  actual.link_angle_b_offset_rad = radians(-1.0);
  Vehicle nominal;
  nominal.kind = clapper();
  const std::vector<Phase> straight = {{0.0, 0.0, 0.45, 40.0}, {0.0, 0.0, -0.45, 20.0}};
  const Result<InternalCalibration> in_line = calibrate_linked({driven_by_phases(actual, straight, 5)}, nominal);
  ASSERT_TRUE(in_line) << in_line.error().message();
  EXPECT_FALSE(linked_parameter(*in_line, "link_angle_a_offset_rad").determined);
  ASSERT_FALSE(in_line->cannot_tell.empty());
  EXPECT_NE(in_line->cannot_tell.front().find("sideways"), std::string::npos);
  const Result<InternalCalibration> sideways = calibrate_linked(
      {driven_by_phases(actual, with_crabbing(), 6), driven_by_phases(actual, with_crabbing(), 7)}, nominal);
  ASSERT_TRUE(sideways) << sideways.error().message();
  expect_found(*sideways, "link_angle_a_offset_rad", radians(1.0), radians(0.3));
  expect_found(*sideways, "link_angle_b_offset_rad", radians(-1.0), radians(0.3));
}

// Standard errors allow for encoders' rounding that holds as long as an angle is held: no less than the errors seen,
// and for angles that wobble, as here, some more.
TEST(LinkedCalibration, ClaimsNoMoreThanItKnows) {
  Clapper actual = clapper();
  actual.truck_b.wheelbase_m = 0.343;
  actual.link_angle_b_offset_rad = 0.01;
  actual.link_length_offset_m = -0.003;
  Vehicle nominal;
  nominal.kind = clapper();
  double chi2 = 0.0;
  int count = 0;
  for (std::uint64_t seed = 20; seed < 28; ++seed) {
    const Result<InternalCalibration> found =
        calibrate_linked({driven_by_phases(actual, with_crabbing(), seed)}, nominal);
    ASSERT_TRUE(found) << found.error().message();
    const std::pair<const char*, double> truth[] = {
        {"truck_a.wheel_radius_left_m", 0.075}, {"truck_a.wheelbase_m", 0.34},     {"truck_b.wheelbase_m", 0.343},
        {"link_angle_a_offset_rad", 0.0},       {"link_angle_b_offset_rad", 0.01}, {"link_length_offset_m", -0.003}};
    for (const auto& [name, should] : truth) {
      const ParameterEstimate& p = linked_parameter(*found, name);
      if (!p.determined) continue;
      const double z = (p.value - should) / p.stderr_value;
      chi2 += z * z;
      ++count;
    }
  }
  EXPECT_GE(count, 40);
  EXPECT_LT(chi2 / count, 1.3);
  EXPECT_GT(chi2 / count, 0.1);
}

TEST(LinkedCalibration, RefusesARecordingOfAnotherVehicle) {
  Vehicle nominal;
  nominal.kind = clapper();
  Recording recording;
  recording.name = "eight.csv";
  EXPECT_EQ(calibrate_linked({recording}, nominal).error().message().substr(0, 28), "eight.csv: found no a_left_w");
}

}  // namespace
}  // namespace odolab
