#include "core/diagnosis/quality/unheard_commands.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

struct HeldCommand {
  double time_s = 0.0, speed_mps = 0.0, yaw_rate_radps = 0.0;
};

constexpr DifferentialDrive kDeafDrive{0.075, 0.075, 0.34};

// Wheels that obey, each command until the next.
std::vector<WheelSample> obeyed(const std::vector<HeldCommand>& commands) {
  std::vector<WheelSample> wheels{{commands[0].time_s, 0.0, 0.0}};
  for (std::size_t i = 0; i + 1 < commands.size(); ++i) {
    const HeldCommand& c = commands[i];
    const double lasts_s = commands[i + 1].time_s - c.time_s,
                 aside_mps = 0.5 * kDeafDrive.wheelbase_m * c.yaw_rate_radps;
    wheels.push_back({commands[i + 1].time_s,
                      wheels[i].left_rad + lasts_s * (c.speed_mps - aside_mps) / kDeafDrive.wheel_radius_left_m,
                      wheels[i].right_rad + lasts_s * (c.speed_mps + aside_mps) / kDeafDrive.wheel_radius_right_m});
  }
  return wheels;
}

// Fifty times a second for twenty seconds: at rest for two, then ahead at 0.3 m/s to and fro by turns of 4 s.
std::vector<HeldCommand> to_and_fro_commands() {
  std::vector<HeldCommand> commands;
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.02 * i;
    commands.push_back({t, t < 2.0 ? 0.0 : 0.3, t < 2.0 ? 0.0 : 0.5 * std::sin(0.5 * kPi * t)});
  }
  return commands;
}

// What a base does that obeys but for the time between two, seen 20 times a second, late by so much.
std::vector<TruthSample> followed(const std::vector<HeldCommand>& commands, double blocked_from_s, double to_s,
                                  double late_s = 0.0) {
  std::vector<TruthSample> truth;
  Pose pose;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const HeldCommand& c = commands[i];
    if (i % 5 == 0) truth.push_back({c.time_s + late_s, pose.position(), pose.heading_rad});
    if (c.time_s >= blocked_from_s && c.time_s < to_s) continue;
    pose.heading_rad += 0.02 * c.yaw_rate_radps;
    pose.x_m += 0.02 * c.speed_mps * std::cos(pose.heading_rad);
    pose.y_m += 0.02 * c.speed_mps * std::sin(pose.heading_rad);
  }
  return truth;
}

TEST(UnheardCommands, AreWhereRowsAreMissingWhileTheBaseDrives) {
  std::vector<HeldCommand> commands = to_and_fro_commands();
  commands.erase(commands.begin() + 450, commands.begin() + 490);  // from 9 to 9.8 s
  commands.erase(commands.begin() + 20, commands.begin() + 60);    // while it rests
  const TimeStretches holes = holes_in_commands(obeyed(commands), kDeafDrive, {});
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0].first, 8.98, 1e-9);
  EXPECT_NEAR(holes[0].second, 9.8, 1e-9);
  EXPECT_TRUE(holes_in_commands(obeyed(to_and_fro_commands()), kDeafDrive, {}).empty());
}

TEST(UnheardCommands, AreNotMissingInALogThatHasARowForEachChange) {
  std::vector<HeldCommand> commands;
  for (int i = 0; i < 60; ++i) commands.push_back({0.05 * i * i, 0.1 + 0.001 * i, 0.0});
  EXPECT_TRUE(holes_in_commands(obeyed(commands), kDeafDrive, {}).empty());
}

// A stick that is let go and held still by turns: few of its rows are far apart.
TEST(UnheardCommands, AreNotMissingWhereTheBaseGoesOnAsItWasToldLast) {
  std::vector<HeldCommand> commands = to_and_fro_commands(), changes;
  for (HeldCommand& c : commands)
    if (c.time_s > 10.0 && c.time_s < 12.0) c.speed_mps = 0.2, c.yaw_rate_radps = 0.4;
  for (const HeldCommand& c : commands)
    if (changes.empty() || c.speed_mps != changes.back().speed_mps || c.yaw_rate_radps != changes.back().yaw_rate_radps)
      changes.push_back(c);
  EXPECT_TRUE(holes_in_commands(obeyed(changes), kDeafDrive, followed(commands, 100.0, 100.0)).empty());
  const TimeStretches holes = holes_in_commands(obeyed(changes), kDeafDrive, followed(commands, 10.5, 12.0));
  ASSERT_FALSE(holes.empty());
  EXPECT_NEAR(holes.back().first, 10.0, 0.03);
  EXPECT_NEAR(holes.back().second, 12.0, 0.03);
}

TEST(UnheardCommands, AreWhereTheBaseIsBlocked) {
  const std::vector<HeldCommand> commands = to_and_fro_commands();
  const TimeStretches unmoved = unmoved_base(obeyed(commands), kDeafDrive, followed(commands, 8.0, 13.0));
  ASSERT_EQ(unmoved.size(), 1u);
  EXPECT_NEAR(unmoved[0].first, 7.5, 0.5);
  EXPECT_NEAR(unmoved[0].second, 13.0, 0.5);
  EXPECT_TRUE(unmoved_base(obeyed(commands), kDeafDrive, followed(commands, 0.0, 0.0)).empty());
}

// It sets off before it is told to, by its stamps, and stands while it is told to drive.
TEST(UnheardCommands, AreNoneWhereTheTruthsClockIsOff) {
  std::vector<HeldCommand> commands = to_and_fro_commands();
  for (HeldCommand& c : commands)
    if (std::fmod(c.time_s, 8.0) > 4.0) c.speed_mps = c.yaw_rate_radps = 0.0;
  for (const double late_s : {0.0, 3.0, -3.0})
    EXPECT_TRUE(unmoved_base(obeyed(commands), kDeafDrive, followed(commands, 0.0, 0.0, late_s)).empty()) << late_s;
}

// Two seconds about the moment at which it turns back begin and end at one place.
TEST(UnheardCommands, AreNoneWhereTheBaseGoesBackWhereItCameFrom) {
  std::vector<HeldCommand> commands;
  for (int i = 0; i < 1000; ++i) commands.push_back({0.02 * i, i / 250 % 2 == 0 ? 0.34 : -0.34, 0.0});
  for (const double late_s : {0.0, 0.1, 0.2, 0.25, 0.3, 0.45})
    EXPECT_TRUE(unmoved_base(obeyed(commands), kDeafDrive, followed(commands, 100.0, 100.0, late_s)).empty()) << late_s;
}

// A total station sees no headings: of a base that turns on the spot, as it is told, it says that it stays there.
TEST(UnheardCommands, AreNoneWhereTheBaseTurnsOnTheSpotUnderATruthWithoutHeadings) {
  std::vector<HeldCommand> commands = to_and_fro_commands();
  for (HeldCommand& c : commands)
    if (std::fmod(c.time_s, 8.0) > 4.0) c.speed_mps = 0.0, c.yaw_rate_radps = 0.5;
  std::vector<TruthSample> truth = followed(commands, 100.0, 100.0), blocked = followed(commands, 8.0, 12.0);
  for (TruthSample& t : truth) t.heading_rad.reset();
  for (TruthSample& t : blocked) t.heading_rad.reset();
  EXPECT_TRUE(unmoved_base(obeyed(commands), kDeafDrive, truth).empty());
  EXPECT_FALSE(unmoved_base(obeyed(commands), kDeafDrive, blocked).empty());  // told to go ahead
}

}  // namespace
}  // namespace odolab
