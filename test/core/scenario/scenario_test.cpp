#include "core/scenario/scenario.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

bool names(const std::vector<std::string>& problems, const std::string& key) {
  for (const std::string& p : problems)
    if (p.rfind(key + ":", 0) == 0) return true;
  return false;
}

TEST(Scenario, IsSoundByDefault) {
  Scenario s;
  s.vehicle.kind = DifferentialDrive{};
  EXPECT_TRUE(problems_in(s).empty());
}

TEST(Scenario, NamesEachKeyThatIsWrong) {
  Scenario s;
  DifferentialDrive d;
  d.wheelbase_m = 0.0;
  s.vehicle.kind = d;
  s.actual.wheel_radius_right_m = -0.1;
  s.actual.drive_wheel_load_share = 1.2;
  s.floor.friction = -1.0;
  s.driving.speed_mps = 0.0;
  s.step_s = 0.1;
  s.sensors.truth_period_s = -1.0;
  s.path = FigureEightPath{1.0, 0};
  s.benchmark = Benchmark{};
  const std::vector<std::string> problems = problems_in(s);
  for (const char* key :
       {"vehicle.wheelbase_m", "actual.wheel_radius_right_m", "actual.drive_wheel_load_share", "floor.friction",
        "driving.speed_mps", "step_s", "sensors.encoder_period_s", "sensors.truth_period_s", "path.loops", "benchmark"})
    EXPECT_TRUE(names(problems, key)) << key;
  EXPECT_EQ(problems.size(), 10u);
}

TEST(Scenario, TakesTheLengthsOfTheDrawingForTheMachine) {
  DifferentialDrive d;
  d.wheelbase_m = 0.5;
  d.wheel_radius_left_m = 0.1;
  const ActualDrive a = as_drawn(d);
  EXPECT_EQ(a.wheelbase_m, 0.5);
  EXPECT_EQ(a.wheel_radius_left_m, 0.1);
  EXPECT_EQ(a.toe_left_rad, 0.0);
}

}  // namespace
}  // namespace odolab
