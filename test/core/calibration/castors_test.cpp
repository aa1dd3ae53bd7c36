#include "core/calibration/castors.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/kinematics/castors.h"

namespace odolab {
namespace {

// The body turns about castor `still`'s pivot; the others begin 0.6 rad off their way and settle on it.
std::vector<CastorSample> revolution(const MultiCastor& actual, std::size_t still, bool clockwise, double turn_rad,
                                     std::uint64_t seed) {
  const double rate = clockwise ? -1.0 : 1.0;
  const Vec2 pivot = actual.castors[still].pivot();
  const BodyTwist about{rate * pivot.y_m, -rate * pivot.x_m, rate, 0.05};
  std::vector<double> angles = trailing_angles(actual, about);
  for (double& angle : angles) angle += 0.6;
  CastorKinematics vehicle(actual, {}, angles);
  std::vector<CastorSample> samples{rounded(vehicle.reading(), actual, seed)};
  for (int i = 0; i < static_cast<int>((turn_rad + 1.2) / 0.05 + 0.5); ++i) {
    vehicle.move(about);
    samples.push_back(rounded(vehicle.reading(), actual, seed));
  }
  return samples;
}

MultiCastor odd_vehicle(double step_wheel_rad, double step_pivot_rad) {
  MultiCastor v = three_castor_vehicle();
  v.wheel_encoder_resolution_rad = step_wheel_rad;
  v.pivot_encoder_resolution_rad = step_pivot_rad;
  v.castors[0].pivot_encoder_offset_rad = 0.2;
  v.castors[1] = {0.25, 2.0 * kPi / 3.0, 0.0503, 0.051, 0.049, 0.061, 0.0585, -2.9};
  v.castors[2].pivot_encoder_offset_rad = 3.0;
  return v;
}

TEST(CastorCalibration, FindsEveryParameterFromExactReadings) {
  const MultiCastor actual = odd_vehicle(0.0, 0.0);
  std::vector<Revolution> runs;
  for (std::size_t still : {0u, 1u, 2u})
    for (bool clockwise : {true, false}) {
      const Result<Revolution> run =
          revolution_in(revolution(actual, still, clockwise, 1.0, 1), three_castor_vehicle());
      ASSERT_TRUE(run) << run.error().message();
      EXPECT_EQ(run->still, still);
      EXPECT_EQ(run->clockwise, clockwise);
      runs.push_back(*run);
    }
  const MultiCastor found = calibrated_castors(runs, three_castor_vehicle());
  for (std::size_t c = 0; c < 3; ++c) {
    const Castor &is = found.castors[c], &should = actual.castors[c];
    // the castors settle within the pivot encoder's step of the vehicle file, 1.2 mrad, and most of the way much closer
    EXPECT_NEAR(is.offset_m, should.offset_m, 1e-4);
    EXPECT_NEAR(is.wheel_radius_left_m, should.wheel_radius_left_m, 3e-5);
    EXPECT_NEAR(is.wheel_radius_right_m, should.wheel_radius_right_m, 3e-5);
    EXPECT_NEAR(is.wheel_offset_left_m, should.wheel_offset_left_m, 1e-4);
    EXPECT_NEAR(is.wheel_offset_right_m, should.wheel_offset_right_m, 1e-4);
    EXPECT_NEAR(wrapped(is.pivot_encoder_offset_rad - should.pivot_encoder_offset_rad), 0.0, 2e-4);
  }
}

// Eqs. 1 to 9 by hand: D = 1 m, Gamma = 30 degrees, theta_perp = -90, beta = 10, r = 0.1 m, d_1 = 0.2, d_2 = 0.3 m.
TEST(CastorCalibration, SolvesAHandWorkedCase) {
  const double axle_m = std::cos(radians(30.0)), turn_rad = 2.0;
  CastorOnCircle cw, ccw;
  cw.pivot_rad = radians(-90.0 + 30.0 + 10.0);
  ccw.pivot_rad = radians(-90.0 + 180.0 - 30.0 + 10.0);
  cw.left_rad = turn_rad * (axle_m + 0.2) / 0.1;    // Eq. 4
  cw.right_rad = turn_rad * (axle_m - 0.3) / 0.1;   // Eq. 5
  ccw.left_rad = turn_rad * (axle_m - 0.2) / 0.1;   // Eq. 6
  ccw.right_rad = turn_rad * (axle_m + 0.3) / 0.1;  // Eq. 7
  ccw.pivot_rad += 2.0 * kPi;                       // differences hold modulo a turn
  const Castor found = castor_from_circles(cw, turn_rad, ccw, turn_rad, 1.0, radians(-90.0));
  EXPECT_NEAR(found.offset_m, 0.5, 1e-12);
  EXPECT_NEAR(degrees(found.pivot_encoder_offset_rad), 10.0, 1e-9);
  EXPECT_NEAR(found.wheel_radius_left_m, 0.1, 1e-12);
  EXPECT_NEAR(found.wheel_radius_right_m, 0.1, 1e-12);
  EXPECT_NEAR(found.wheel_offset_left_m, 0.2, 1e-12);
  EXPECT_NEAR(found.wheel_offset_right_m, 0.3, 1e-12);
}

// Mounted the other way round: half a turn more is half a turn less, and no error of a turn.
TEST(CastorCalibration, KnowsAnEncoderThatIsOffByHalfATurnAsWellAsAnyOther) {
  MultiCastor actual = odd_vehicle(0.00524, 0.00122);
  actual.castors[0].pivot_encoder_offset_rad = kPi;
  Vehicle nominal;
  nominal.kind = three_castor_vehicle();
  constexpr std::size_t kOffset = 5;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::vector<Recording> recordings;
    for (std::size_t still : {0u, 1u, 2u})
      for (bool clockwise : {true, false})
        recordings.push_back(recording_of(
            revolution(actual, still, clockwise, 1.5, seed_of_stream(seed, 2 * still + (clockwise ? 1 : 0)))));
    const Result<InternalCalibration> found = calibrate_castors(recordings, nominal);
    ASSERT_TRUE(found) << found.error().message();
    const ParameterEstimate &half = found->parameters[kOffset], &other = found->parameters[2 * 6 + kOffset];
    EXPECT_NEAR(wrapped(half.value - kPi), 0.0, 4.0 * half.stderr_value);
    EXPECT_NEAR(half.stderr_value, other.stderr_value, 0.1 * other.stderr_value);
  }
}

TEST(CastorCalibration, ClaimsStandardErrorsThatHold) {
  const MultiCastor actual = odd_vehicle(0.00524, 0.00122);
  Vehicle nominal;
  nominal.kind = three_castor_vehicle();
  double chi2 = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<Recording> recordings;
    for (std::size_t still : {0u, 1u, 2u})
      for (bool clockwise : {true, false})
        recordings.push_back(recording_of(
            revolution(actual, still, clockwise, 1.5, seed_of_stream(seed, 2 * still + (clockwise ? 1 : 0)))));
    const Result<InternalCalibration> found = calibrate_castors(recordings, nominal);
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_TRUE(found->cannot_tell.empty());
    for (std::size_t c = 0; c < 3; ++c) {
      const double should[6] = {actual.castors[c].offset_m,
                                actual.castors[c].wheel_radius_left_m,
                                actual.castors[c].wheel_radius_right_m,
                                actual.castors[c].wheel_offset_left_m,
                                actual.castors[c].wheel_offset_right_m,
                                actual.castors[c].pivot_encoder_offset_rad};
      for (std::size_t k = 0; k < 6; ++k) {
        const ParameterEstimate& p = found->parameters[6 * c + k];
        const double z = (k == 5 ? wrapped(p.value - should[k]) : p.value - should[k]) / p.stderr_value;
        chi2 += z * z;
        ++count;
      }
    }
  }
  // 360 normalised errors, of which those of one run hang together: their mean square is 1, within a third
  EXPECT_NEAR(chi2 / count, 1.0, 0.33);
}

TEST(CastorCalibration, SaysWhatARecordingIsNot) {
  const MultiCastor vehicle = three_castor_vehicle();
  std::vector<CastorSample> straight;
  CastorKinematics moving(vehicle, {});
  for (int i = 0; i < 20; ++i) {
    straight.push_back(moving.reading());
    moving.move({0.3, 0.0, 0.0, 0.05});
  }
  EXPECT_NE(revolution_in(straight, vehicle).error().message().find("held still"), std::string::npos);
  Vehicle nominal;
  nominal.kind = vehicle;
  const Result<InternalCalibration> one_way =
      calibrate_castors({recording_of(revolution(vehicle, 0, true, 1.0, 1))}, nominal);
  ASSERT_TRUE(one_way);
  EXPECT_EQ(one_way->cannot_tell.size(), 3u);
  EXPECT_FALSE(one_way->parameters[6].determined);
}

}  // namespace
}  // namespace odolab
