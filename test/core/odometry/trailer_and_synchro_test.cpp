#include <gtest/gtest.h>

#include "core/kinematics/trucks.h"
#include "core/odometry/encoder_trailer.h"
#include "core/odometry/synchro_drive.h"

namespace odolab {
namespace {

// The tow turns on the spot under a trailer that stands: nothing but the hitch moves.
TEST(EncoderTrailer, CarriesItsPoseOverTheHitch) {
  EncoderTrailer v;
  v.hitch_angle_offset_rad = 0.1;
  const Pose tow = trailer_T_tow(v, 0.1 + 0.5 * kPi);
  EXPECT_NEAR(tow.x_m, v.drawbar_length_m, 1e-15);  // the hitch is ahead of the axle, the tow to its left
  EXPECT_NEAR(tow.y_m, v.hitch_offset_m, 1e-15);
  EXPECT_NEAR(tow.heading_rad, 0.5 * kPi, 1e-15);
}

// Forward, then backward until the trailer has swivelled and leads, its hitch angle through pi and beyond.
TEST(EncoderTrailer, FollowsTheTowThroughItsSwivelInReverse) {
  EncoderTrailer v;
  v.hitch_angle_offset_rad = 0.02;
  TrailerKinematics moving(v, {1.0, 2.0, 0.5}, 0.05);
  std::vector<TrailerSample> samples{moving.reading()};
  double widest_rad = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double speed_mps = i < 500 ? 0.3 : -0.3;
    moving.move({speed_mps, 0.2 * std::sin(0.01 * i)}, 0.01);
    samples.push_back(moving.reading());
    widest_rad = std::max(widest_rad, std::abs(moving.hitch_angle_rad()));
  }
  EXPECT_GT(widest_rad, 0.8 * kPi);  // it did swivel
  const Track track = trailer_reckoned(samples, v, {1.0, 2.0, 0.5});
  // 9 m in steps of 10 ms: the middle heading's error is of second order, under 0.1 mm
  EXPECT_LT(length(track.back().pose.position() - moving.tow().position()), 1e-4);
  EXPECT_NEAR(wrapped(track.back().pose.heading_rad - moving.tow().heading_rad), 0.0, 1e-6);
}

TEST(EncoderTrailer, DoesNotLookAtTheTowsSlippingTracks) {
  EncoderTrailer v;
  TrailerKinematics moving(v, {}, 0.0);
  std::vector<TrailerSample> samples{moving.reading()};
  for (int i = 0; i < 100; ++i) {
    moving.move({0.3, 0.3}, 0.01);
    moving.add_idle_rotation({0.5, -0.5}, {});
    samples.push_back(moving.reading());
  }
  EXPECT_LT(length(trailer_reckoned(samples, v, {}).back().pose.position() - moving.tow().position()), 1e-4);
}

// A square by steering at each corner: the base comes back and its wheels point as at the start.
TEST(SynchroDrive, DrivesASquareByHand) {
  const SynchroDrive drive;
  std::vector<SynchroSample> samples{{0.0, 0.0, 0.0}};
  for (int side = 0; side < 4; ++side) {
    SynchroSample next = samples.back();
    next.wheel_rad += 1.0 / drive.wheel_radius_m;
    samples.push_back(next);
    next.steering_rad += 0.5 * kPi;
    samples.push_back(next);
  }
  const Track track = synchro_reckoned(samples, drive, {});
  EXPECT_NEAR(track[1].pose.x_m, 1.0, 1e-15);
  EXPECT_NEAR(track[3].pose.y_m, 1.0, 1e-15);
  EXPECT_NEAR(length(track.back().pose.position()), 0.0, 1e-15);
  EXPECT_NEAR(track.back().pose.heading_rad, 2.0 * kPi, 1e-15);
}

TEST(SynchroDrive, TakesOffWhatSteeringRollsAndAddsWhatTheBaseTurns) {
  SynchroDrive drive;
  drive.wheel_rad_per_steering_rad = 0.5;
  drive.base_turn_rad_per_steering_rad = 0.01;
  drive.steering_ratio = 1.02;
  // One turn of the steering encoder: the wheels turned by 2 pi / 1.02 and rolled half of that without moving anything.
  const double steered = 2.0 * kPi / 1.02;
  const Track track = synchro_reckoned({{0.0, 0.0, 0.0}, {1.0, 0.5 * steered, 2.0 * kPi}}, drive, {});
  EXPECT_NEAR(length(track.back().pose.position()), 0.0, 1e-15);
  EXPECT_NEAR(track.back().pose.heading_rad, 1.01 * steered, 1e-14);
  drive = {};
  drive.base_turn_rad_per_m = 0.05;
  EXPECT_NEAR(synchro_reckoned({{0.0, 0.0, 0.0}, {1.0, 2.0 / 0.127, 0.0}}, drive, {}).back().pose.heading_rad, 0.1,
              1e-14);
}

}  // namespace
}  // namespace odolab
