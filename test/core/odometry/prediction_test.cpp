#include "core/odometry/prediction.h"

#include <gtest/gtest.h>

#include <limits>

namespace odolab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A straight of 1 m/s read every second, seen first at t = 0.5 s by a truth that is mounted 0.2 m ahead and 0.1 s late.
struct Straight {
  Recording recording;
  Vehicle vehicle;

  Straight() {
    const double w = 1.0 / 0.075;
    recording.time_s = {0.0, 0.6, 1.0, 2.0};
    recording.channels = {{"left_wheel_rad", {0.0, kNone, w, 2.0 * w}}, {"right_wheel_rad", {0.0, kNone, w, 2.0 * w}},
                          {"truth_x_m", {kNone, 5.0, kNone, 99.0}},     {"truth_y_m", {kNone, 7.0, kNone, 99.0}},
                          {"truth_heading_rad", {kNone, 0.5 * kPi, kNone, 99.0}}};
    vehicle.truth.axle_T_tracked = {0.2, 0.0, 0.0};
    vehicle.truth.time_offset_s = 0.1;
  }
};

TEST(Prediction, PassesThroughTheFirstTruthSampleAndLooksAtNoOther) {
  const Straight drive;
  const Track track = *predicted_track(drive.recording, drive.vehicle);
  ASSERT_EQ(track.size(), 3u);  // one for each wheel sample
  // At the truth's 0.6 s, its clock being 0.1 s late, the tracked point stands at (5, 7) and moves along y at 1 m/s.
  const auto there = pose_at(track, 0.6);
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->x_m, 5.0, 1e-12);
  EXPECT_NEAR(there->y_m, 7.0, 1e-12);
  EXPECT_NEAR(track[2].time_s, 2.1, 1e-12);
  EXPECT_NEAR(track[2].pose.y_m, 8.5, 1e-12);
  EXPECT_NEAR(track[2].pose.heading_rad, 0.5 * kPi, 1e-12);
}

TEST(Prediction, StandsStillUntilTheWheelsAreRead) {
  Straight drive;
  drive.vehicle.truth = {};
  drive.recording.time_s = {-1.0, 0.0, 1.0, 2.0};
  drive.recording.channels[0].values = {kNone, 0.0, 10.0, 20.0};
  drive.recording.channels[1].values = {kNone, 0.0, 10.0, 20.0};
  for (int c : {2, 3, 4}) drive.recording.channels[static_cast<std::size_t>(c)].values = {1.0, kNone, kNone, kNone};
  const Track track = *predicted_track(drive.recording, drive.vehicle);
  EXPECT_NEAR(track[0].pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(track[0].pose.heading_rad, 1.0, 1e-12);
}

TEST(Prediction, HoldsEachCommandUntilTheNext) {
  Recording recording;
  recording.time_s = {0.0, 1.0, 2.0};
  recording.channels = {{"command_speed_mps", {0.5, 0.0, 0.0}}, {"command_yaw_rate_radps", {0.0, 0.3, 0.0}}};
  const Track track = *predicted_track(recording, Vehicle{});
  EXPECT_NEAR(track[1].pose.x_m, 0.5, 1e-12);
  EXPECT_NEAR(track[2].pose.heading_rad, 0.3, 1e-12);
}

TEST(Prediction, SaysWhatIsMissing) {
  Recording recording;
  recording.name = "run.csv";
  recording.time_s = {0.0};
  const Result<Track> track = predicted_track(recording, Vehicle{});
  ASSERT_FALSE(track);
  EXPECT_NE(track.error().message().find("left_wheel_rad"), std::string::npos);
}

}  // namespace
}  // namespace odolab
