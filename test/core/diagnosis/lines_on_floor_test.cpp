#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"
#include "test/support/other_room.h"

namespace odolab::test {
namespace {

// Runs on a floor with a line across it: through x 0.2 m, y 0 m, at 30 degrees to the x axis, 4 cm wide.
constexpr double kTowards_rad = kPi * 120.0 / 180.0;
double past_m(const Vec2& place) {
  return std::cos(kTowards_rad) * (place.x_m - 0.2) + std::sin(kTowards_rad) * place.y_m;
}
bool is_on_line(const Vec2& place) { return std::abs(past_m(place)) < 0.02; }

// `room`: where the truth has the origin of that floor.
Diagnosis on_a_lined_floor(const std::function<void(InjectedStep&)>& what_happens, const Pose& room = {}) {
  Random random(61);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.05);
  g.duration_s = 60.0;
  // Eights that do not close, across the line some twenty times a run.
  const auto driving = [](int run) {
    return [run](double t) {
      const double forward = 5.0 + 1.5 * std::sin(0.6 * t);
      const double turning = (1.8 + 0.2 * run) * std::tanh(4.0 * std::sin(2.0 * kPi * t / (20.0 + run)));
      return WheelSpeedsAt{forward - turning, forward + turning};
    };
  };
  std::vector<Recording> runs = three_runs(g, random, driving, [&](int) { return what_happens; });
  for (Recording& run : runs) run = in_room(std::move(run), room);
  return diagnose(runs, {}, Vehicle{}).value();
}

void turns_on_the_line(InjectedStep& s) {
  if (!is_on_line(s.pose.position())) return;
  const double way_m = 0.5 * std::abs(s.left_m + s.right_m);
  s.turn_rad += 0.4 * way_m * std::sin(2.0 * (kTowards_rad - s.pose.heading_rad));
}

void expect_unknown_on_the_line(const Diagnosis& d) {
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const std::string& regime = d.findings.front().where.regime;
  EXPECT_NE(regime.find("a line across the floor"), std::string::npos) << regime;
  EXPECT_NE(regime.find("at 30 degrees"), std::string::npos) << regime;
}

TEST(LinesOnFloor, AreFoundWhereAJointTurnsWhateverCrossesItTowardsItsNormal) {
  expect_unknown_on_the_line(on_a_lined_floor(turns_on_the_line));
}

// Where places are counted from says nothing of the room: a satellite's are hundreds of kilometres from theirs.
TEST(LinesOnFloor, AreSaidByAPlaceInTheRoom) {
  const Pose room{500000.0, 4000000.0, 0.0};
  const Diagnosis d = on_a_lined_floor(turns_on_the_line, room);
  expect_unknown_on_the_line(d);
  const std::string& regime = d.findings.front().where.regime;
  Vec2 said;
  ASSERT_EQ(std::sscanf(regime.c_str() + regime.find("through x "), "through x %lf, y %lf m", &said.x_m, &said.y_m), 2);
  EXPECT_LT(length(said - room.position()), 10.0) << regime;
}

TEST(LinesOnFloor, AreFoundWhereTwoMapsDoNotMeet) {
  expect_unknown_on_the_line(on_a_lined_floor([](InjectedStep& s) {
    if (!is_on_line(s.pose.position())) return;
    const double over_m = 0.5 * (s.left_m + s.right_m) * std::cos(s.pose.heading_rad - kTowards_rad);
    s.room_m = s.room_m + (0.006 / 0.04 * over_m) * Vec2{0.8, 0.6};
  }));
}

TEST(LinesOnFloor, AreNotWhereNothingIs) {
  const Diagnosis d = on_a_lined_floor([](InjectedStep&) {});
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
}

}  // namespace
}  // namespace odolab::test
