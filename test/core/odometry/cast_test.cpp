#include "core/odometry/cast.h"

#include <gtest/gtest.h>

#include "core/kinematics/castors.h"
#include "core/odometry/cast_rejection.h"

namespace odolab {
namespace {

MultiCastor ideal() {
  MultiCastor vehicle = three_castor_vehicle();
  vehicle.wheel_encoder_resolution_rad = vehicle.pivot_encoder_resolution_rad = 0.0;
  return vehicle;
}

struct CastorDrive {
  std::vector<CastorSample> samples;
  Pose end;
};

// Twists one after the other, read every `period_s`, exactly or as the encoders round it.
CastorDrive drive_castors(const MultiCastor& actual, const std::vector<BodyTwist>& twists, double period_s,
                          bool rounding = false) {
  CastorKinematics vehicle(actual, {}, trailing_angles(actual, twists.front()));
  const auto read = [&] { return rounding ? rounded(vehicle.reading(), actual, 3) : vehicle.reading(); };
  CastorDrive result;
  result.samples.push_back(read());
  for (BodyTwist twist : twists) {
    const int intervals = static_cast<int>(twist.duration_s / period_s + 0.5);
    twist.duration_s = period_s;
    for (int i = 0; i < intervals; ++i) {
      vehicle.move(twist);
      result.samples.push_back(read());
    }
  }
  result.end = vehicle.body();
  return result;
}

double position_error_m(const CastorDrive& drive, const MultiCastor& vehicle, const CastOptions& options = {}) {
  return length(castor_track(drive.samples, vehicle, {}, options).back().pose.position() - drive.end.position());
}

const std::vector<BodyTwist> kCrabbing = {{0.3, 0.0, 0.0, 2.0}, {0.0, 0.3, 0.2, 2.0}, {-0.2, 0.1, -0.4, 3.0}};

// One castor at the origin's left and one at its right, each going 10 mm along x, the right one 2 mm more.
TEST(Cast, SolvesTwoCastorsByHand) {
  Castor left, right;
  left.pivot_angle_rad = 0.5 * kPi;
  right.pivot_angle_rad = -0.5 * kPi;
  const std::vector<PivotWay> ways = {{&left, {0.010, 0.0}}, {&right, {0.012, 0.0}}};
  CastOptions printed;
  printed.linearisation = Linearisation::old_heading;
  const Pose moved = moved_by_pivots({}, ways, printed);
  EXPECT_NEAR(moved.x_m, 0.011, 1e-15);
  EXPECT_NEAR(moved.y_m, 0.0, 1e-15);
  EXPECT_NEAR(moved.heading_rad, 0.002 / 0.5, 1e-15);  // pivots 0.5 m apart, the right one ahead: to the left
  printed.method = CastorMethod::cast_centred;         // Eq. 22
  EXPECT_NEAR(moved_by_pivots({}, ways, printed).heading_rad, 0.002 / 0.5, 1e-15);
  printed.method = CastorMethod::ipec;  // Eq. 10, and the position of the first
  const Pose by_ipec = moved_by_pivots({}, ways, printed);
  EXPECT_NEAR(by_ipec.heading_rad, std::atan(0.002 / 0.5), 1e-15);
  EXPECT_NEAR(by_ipec.x_m, 0.010 + 0.25 * std::sin(by_ipec.heading_rad), 1e-15);
}

TEST(Cast, CentredFormIsTheGeneralOneForCentredPivots) {
  const CastorDrive run = drive_castors(ideal(), kCrabbing, 0.05);
  CastOptions centred;
  centred.method = CastorMethod::cast_centred;
  const Pose a = castor_track(run.samples, ideal(), {}).back().pose;
  const Pose b = castor_track(run.samples, ideal(), {}, centred).back().pose;
  EXPECT_NEAR(length(a.position() - b.position()), 0.0, 1e-12);  // rounding of doubles over 140 intervals
  EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-12);
  centred.left_out = 1;
  EXPECT_EQ(problem_in(centred, ideal()).substr(0, 8), "castors:");
}

TEST(Cast, FollowsExactMotionToSecondOrder) {
  const double coarse_m = position_error_m(drive_castors(ideal(), kCrabbing, 0.1), ideal());
  const double fine_m = position_error_m(drive_castors(ideal(), kCrabbing, 0.05), ideal());
  EXPECT_LT(fine_m, 0.002);
  EXPECT_NEAR(coarse_m / fine_m, 4.0, 0.8);
  CastOptions printed;
  printed.heading = HeadingRule::end_as_printed;
  EXPECT_NEAR(position_error_m(drive_castors(ideal(), kCrabbing, 0.1), ideal(), printed) /
                  position_error_m(drive_castors(ideal(), kCrabbing, 0.05), ideal(), printed),
              2.0, 0.4);
}

// Turning on the spot about the middle of three pivots the old heading's error cancels, of two it does not.
TEST(Cast, LinearisesAtTheMiddleHeading) {
  const CastorDrive spin = drive_castors(ideal(), {{0.0, 0.0, 0.75, 20.0}}, 0.05);
  CastOptions old_heading;
  old_heading.linearisation = Linearisation::old_heading;
  EXPECT_LT(position_error_m(spin, ideal(), old_heading), 1e-6);
  old_heading.left_out = 1;
  CastOptions middle;
  middle.left_out = 1;
  EXPECT_LT(position_error_m(spin, ideal(), middle), 1e-3);
  const CastorDrive arc = drive_castors(ideal(), {{0.3, 0.0, 0.75, 4.0}}, 0.05);
  EXPECT_LT(position_error_m(arc, ideal(), middle), 0.5 * position_error_m(arc, ideal(), old_heading));
}

TEST(Cast, WithTwoCastorsIsNearlyIpec) {
  MultiCastor wrong = ideal();
  wrong.castors[1].wheel_radius_left_m *= 1.01;
  wrong.castors[2].wheel_radius_right_m *= 0.99;
  const CastorDrive run = drive_castors(ideal(), kCrabbing, 0.05);
  CastOptions cast, ipec;
  cast.left_out = ipec.left_out = 1;
  ipec.method = CastorMethod::ipec;
  const Pose a = castor_track(run.samples, wrong, {}, cast).back().pose;
  const Pose b = castor_track(run.samples, wrong, {}, ipec).back().pose;
  const double error_m = length(a.position() - run.end.position());
  EXPECT_GT(error_m, 0.005);
  // The direction between two pivots is all there is to tell the heading by, up to the square of their disagreement;
  // the position is the first one's alone, or the mean of both.
  EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-4);
  EXPECT_LT(length(a.position() - b.position()), 0.3 * error_m);
}

TEST(Cast, TakesCastorsOfUnequalWheelsAndAnyLayout) {
  MultiCastor odd = ideal();
  odd.castors.resize(2);
  odd.castors[0] = {0.4, 0.3, 0.06, 0.051, 0.049, 0.055, 0.07, 0.2};
  odd.castors[1] = {0.1, 2.0, -0.04, 0.06, 0.05, 0.05, 0.04, -1.0};  // the axle ahead of its pivot
  EXPECT_TRUE(problems_in(odd).empty());
  EXPECT_LT(position_error_m(drive_castors(odd, {{0.3, 0.1, 0.0, 2.0}, {0.1, 0.2, 0.2, 1.0}}, 0.01), odd), 0.0005);
}

TEST(Cast, SaysWhichOptionsDoNotFit) {
  CastOptions options;
  options.left_out = 4;
  EXPECT_EQ(problem_in(options, ideal()), "left_out: found 4, expected 0 (none) to 3");
  options.left_out = 0;
  options.method = CastorMethod::ipec;
  EXPECT_EQ(problem_in(options, ideal()), "castors: found 3 for IPEC, expected two: leave the others out");
}

// A wheel of castor 2 spins on a slippery patch for half a second: 20 % of its way.
TEST(CastWithRejection, DisregardsASlippingCastorWhileItLasts) {
  const MultiCastor vehicle = three_castor_vehicle();
  CastorKinematics moving(vehicle, {}, trailing_angles(vehicle, {0.3, 0.0, 0.0, 0.0}));
  std::vector<CastorSample> samples{rounded(moving.reading(), vehicle, 5)};
  for (int i = 0; i < 200; ++i) {
    moving.move({0.3, 0.0, i % 100 < 50 ? 0.1 : -0.1, 0.05});
    if (i >= 60 && i < 70) moving.add_idle_rotation(1, 0.2 * 0.3 * 0.05 / 0.05, 0.0);
    samples.push_back(rounded(moving.reading(), vehicle, 5));
  }
  const RejectingTrack rejecting = castor_track_with_rejection(samples, vehicle, {});
  ASSERT_EQ(rejecting.disregarded.size(), 1u);
  EXPECT_EQ(rejecting.disregarded[0].castor, 2);
  EXPECT_NEAR(rejecting.disregarded[0].from_s, 3.0, 0.06);  // the interval before its first sample, 50 ms
  EXPECT_NEAR(rejecting.disregarded[0].to_s, 3.5, 0.26);    // taken back after three quiet intervals
  const auto heading_error_deg = [&](const Track& track) {
    return std::abs(degrees(track.back().pose.heading_rad - moving.body().heading_rad));
  };
  const double plain_deg = heading_error_deg(castor_track(samples, vehicle, {}));
  // 30 mm on one wheel: 15 mm along and 12.5 mm across for one of three pivots at 0.25 m, at most 1.5 degrees
  EXPECT_GT(plain_deg, 0.4);
  EXPECT_LT(heading_error_deg(rejecting.track), 0.2 * plain_deg);
}

TEST(CastWithRejection, SuspectsNobodyWhereAllIsWell) {
  const MultiCastor vehicle = three_castor_vehicle();
  MultiCastor off = vehicle;  // within what is trusted: 0.5 % of the radii
  off.castors[0].wheel_radius_left_m *= 1.005;
  off.castors[2].wheel_radius_right_m *= 0.995;
  std::vector<BodyTwist> twists;
  for (int i = 0; i < 10; ++i) twists.insert(twists.end(), kCrabbing.begin(), kCrabbing.end());
  const CastorDrive run = drive_castors(off, twists, 0.05, true);
  const RejectingTrack rejecting = castor_track_with_rejection(run.samples, vehicle, {});
  EXPECT_TRUE(rejecting.disregarded.empty());
  const Pose plain = castor_track(run.samples, vehicle, {}).back().pose;
  EXPECT_EQ(rejecting.track.back().pose.x_m, plain.x_m);
}

}  // namespace
}  // namespace odolab
