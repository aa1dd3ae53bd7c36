#include "core/diagnosis/quality/obeying_wheels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/geometry/angles.h"
#include "core/odometry/differential_drive.h"

namespace odolab {
namespace {

const double kNotRead = std::nan("");
constexpr DifferentialDrive kObeyingDrive{0.07, 0.08, 0.4};

// A quarter of a circle of 1 m that is told once, and a truth in between.
Recording quarter_turn() {
  Recording r;
  r.time_s = {0.0, 0.7, 2.0, 2.0};
  r.channels = {{"command_speed_mps", {0.25 * kPi, kNotRead, 0.0, kNotRead}},
                {"command_yaw_rate_radps", {0.25 * kPi, kNotRead, 0.0, kNotRead}},
                {"truth_x_m", {kNotRead, 0.5, kNotRead, 1.0}}};
  return r;
}

TEST(ObeyingWheels, DriveAlongTheArcThatIsToldAndNotAlongItsChord) {
  const Recording obeying = with_obeying_wheels(quarter_turn(), kObeyingDrive);
  ASSERT_TRUE(problems_in(obeying).empty());
  const Track track = dead_reckoned(wheel_samples(obeying, kObeyingDrive), kObeyingDrive, Pose{}, HeadingRule::arc);
  ASSERT_GE(track.size(), 101u);  // 2 s in steps of 0.02 s
  for (const TimedPose& p : track) {
    const double turned = 0.25 * kPi * p.time_s;
    EXPECT_NEAR(p.pose.x_m, std::sin(turned), 1e-12);
    EXPECT_NEAR(p.pose.y_m, 1.0 - std::cos(turned), 1e-12);
  }
}

TEST(ObeyingWheels, LeaveWhatWasRecordedAsItWas) {
  const Recording given = quarter_turn(), obeying = with_obeying_wheels(given, kObeyingDrive);
  EXPECT_EQ(command_samples(obeying).size(), 2u);
  const Channel& truth = *obeying.channel("truth_x_m");
  std::vector<std::pair<double, double>> samples;
  for (std::size_t i = 0; i < truth.values.size(); ++i)
    if (!std::isnan(truth.values[i])) samples.emplace_back(obeying.time_s[i], truth.values[i]);
  EXPECT_EQ(samples, (std::vector<std::pair<double, double>>{{0.7, 0.5}, {2.0, 1.0}}));
}

TEST(ObeyingWheels, AreReadAtEachCommandAloneWhereTheseComeOftenEnough) {
  Recording often;
  for (int i = 0; i < 50; ++i) often.time_s.push_back(0.01 * i);
  often.channels = {{"command_speed_mps", std::vector<double>(50, 0.3)},
                    {"command_yaw_rate_radps", std::vector<double>(50, 0.1)}};
  EXPECT_EQ(with_obeying_wheels(often, kObeyingDrive).time_s, often.time_s);
}

// With an effect that does nothing the prediction goes along that arc, too, and has a row for each command.
TEST(ObeyingWheels, PredictARowForEachCommandAlongTheArc) {
  Recording told = quarter_turn();
  told.channels.pop_back();
  Vehicle vehicle;
  vehicle.kind = kObeyingDrive;
  const Track track = predicted_track(told, vehicle, {{"one_sided_drag", "vehicle", {{"rad_per_m", 0.0}}}}).value();
  ASSERT_EQ(track.size(), 2u);
  EXPECT_EQ(track[1].time_s, 2.0);
  EXPECT_NEAR(track[1].pose.x_m, 1.0, 1e-9);
  EXPECT_NEAR(track[1].pose.y_m, 1.0, 1e-9);
}

// A row that claims to hold for a day makes no day of rows.
TEST(ObeyingWheels, StayFewWhereACommandIsHeldForVeryLong) {
  Recording day;
  day.time_s = {0.0, 86400.0};
  day.channels = {{"command_speed_mps", {0.1, 0.0}}, {"command_yaw_rate_radps", {0.0, 0.0}}};
  EXPECT_LE(with_obeying_wheels(day, kObeyingDrive).time_s.size(), 4001u);
}

}  // namespace
}  // namespace odolab
