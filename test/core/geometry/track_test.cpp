#include "core/geometry/track.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

Track track_at(double speed, double turn_rate, double duration_s, double dt = 0.1) {
  Track t;
  Pose p;
  for (int i = 0; i * dt <= duration_s + 1e-9; ++i) {
    t.push_back({i * dt, p});
    p = advanced(p, speed * dt, turn_rate * dt);
  }
  return t;
}

TEST(Track, IsLinearBetweenItsPosesAndEndsWhereItEnds) {
  const Track t = {{1.0, {0, 0, 0}}, {2.0, {1, 2, 0.4}}};
  EXPECT_NEAR(pose_at(t, 1.25)->y_m, 0.5, 1e-15);
  EXPECT_NEAR(pose_at(t, 2.0)->heading_rad, 0.4, 1e-15);
  EXPECT_FALSE(pose_at(t, 0.99));
  EXPECT_FALSE(pose_at(t, 2.01));
  EXPECT_FALSE(pose_at({}, 0.0));
}

TEST(Track, UnwrapsAndMeasuresItself) {
  Track t = {{0, {0, 0, 3.0}}, {1, {3, 4, -3.0}}, {2, {3, 4, 3.1}}};
  unwrap_headings(t);
  EXPECT_NEAR(t[1].pose.heading_rad, 2 * kPi - 3.0, 1e-15);
  EXPECT_NEAR(t[2].pose.heading_rad, 3.1, 1e-15);
  EXPECT_NEAR(travelled_m(t), 5.0, 1e-15);
}

TEST(TrackError, IsZeroOnItselfAndBlindToTheFrame) {
  const Track t = track_at(0.5, 0.2, 20.0);
  Track moved = t;
  for (TimedPose& p : moved) p.pose = Pose{3, -2, 1.0} * p.pose;
  const auto e = track_error(moved, t);
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->position_rms_m, 0.0, 1e-12);
  EXPECT_NEAR(e->largest_position_m, 0.0, 1e-12);
  EXPECT_GT(e->windows, 5);
}

TEST(TrackError, GathersAScaleErrorOverOneMetre) {
  // One per cent too far: 10 mm in each metre, 100 mm after ten.
  const auto e = track_error(track_at(0.505, 0.0, 20.0), track_at(0.5, 0.0, 20.0));
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->position_rms_m, 0.010, 0.0006);  // a window ends within one stride of 50 mm beyond its metre
  EXPECT_NEAR(e->end_position_m, 0.1, 1e-9);
  EXPECT_NEAR(e->heading_rms_rad, 0.0, 1e-12);
}

TEST(TrackError, GathersATurnErrorOverOneRadian) {
  const auto e = track_error(track_at(0.0, 0.51, 40.0), track_at(0.0, 0.5, 40.0));
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->heading_rms_rad, 0.02, 0.0011);  // 2 % of a radian, and a stride of 0.05 rad more
  EXPECT_NEAR(e->end_heading_rad, 0.4, 1e-9);
}

TEST(TrackError, NeedsTwoSharedTimes) {
  EXPECT_FALSE(track_error({}, track_at(1, 0, 1)));
  Track late = track_at(1, 0, 1);
  for (TimedPose& p : late) p.time_s += 5.0;
  EXPECT_FALSE(track_error(late, track_at(1, 0, 1)));
}

}  // namespace
}  // namespace odolab
