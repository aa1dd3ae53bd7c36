#include "core/calibration/odd_recordings.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"

namespace odolab {
namespace {

const DifferentialDrive kRobot{0.0996, 0.1003, 0.4565};

Vehicle with_drawn_lengths() {
  Vehicle v;
  v.kind = DifferentialDrive{0.1, 0.1, 0.45};
  return v;
}

DifferentialDrive scaled(DifferentialDrive drive, double left, double right, double wheelbase) {
  drive.wheel_radius_left_m *= left;
  drive.wheel_radius_right_m *= right;
  drive.wheelbase_m *= wheelbase;
  return drive;
}

std::vector<Recording> one_run_of_each(const std::vector<DifferentialDrive>& robots) {
  std::vector<Recording> runs;
  Random random(31);
  for (const DifferentialDrive& robot : robots) {
    test::GeneratorSettings g = test::under_motion_capture(robot, 0.0005, 0.05);
    g.duration_s = 60.0;
    runs.push_back(generated(g, test::varied_driving(random, g.duration_s), random));
    runs.back().name = "run_" + std::to_string(runs.size()) + ".csv";
  }
  return runs;
}

std::vector<std::string> names_of(const std::vector<Recording>& runs) {
  std::vector<std::string> names;
  for (const Recording& run : runs) names.push_back(run.name);
  return names;
}

TEST(OddRecordings, AreThoseOfAnotherVehicle) {
  const DifferentialDrive other = scaled(kRobot, 0.85, 0.86, 0.92);
  const std::vector<Recording> runs = one_run_of_each({kRobot, kRobot, other, kRobot});
  const std::vector<OddRecording> odd = odd_recordings(runs, with_drawn_lengths());
  ASSERT_EQ(odd.size(), 1u);
  EXPECT_EQ(odd[0].index, 2u);
  EXPECT_EQ(odd[0].others, (std::vector<std::size_t>{0, 1, 3}));
  ASSERT_EQ(odd[0].lengths.size(), 3u);
  const double by[] = {-0.15, -0.14, -0.08};
  // Some standard errors: 0.5 mm on a root metre of 20 m are 1e-4 of a radius, and ten times that of a wheelbase.
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(odd[0].lengths[static_cast<std::size_t>(k)].by, by[k], 0.004) << odd[0].lengths[k].name;
  const std::string said = in_words(odd[0], names_of(runs));
  EXPECT_EQ(said.rfind("run_3.csv does not go with run_1.csv, run_2.csv and run_4.csv:", 0), 0u) << said;
}

TEST(OddRecordings, OfTwoStandAgainstEachOther) {
  const std::vector<Recording> runs = one_run_of_each({kRobot, scaled(kRobot, 1.0, 0.97, 1.0)});
  const std::vector<OddRecording> odd = odd_recordings(runs, with_drawn_lengths());
  ASSERT_EQ(odd.size(), 1u);
  ASSERT_EQ(odd[0].lengths.size(), 1u);  // a flat tyre makes no other wheelbase
  EXPECT_EQ(odd[0].lengths[0].name, "wheel_radius_right_m");
  const std::string said = in_words(odd[0], names_of(runs));
  EXPECT_NE(said.find("run_2.csv does not go with run_1.csv"), std::string::npos) << said;
  EXPECT_NE(said.find("% smaller than that one"), std::string::npos) << said;
}

TEST(OddRecordings, AreNotThoseOfWarmTyresOrALightLoad) {
  EXPECT_TRUE(odd_recordings(one_run_of_each({kRobot, scaled(kRobot, 1.002, 1.002, 1.0),
                                              scaled(kRobot, 0.998, 0.998, 1.0), scaled(kRobot, 1.0, 0.998, 1.002)}),
                             with_drawn_lengths())
                  .empty());
}

// On the spot only ratios show, and the wheels stay as large as they are drawn.
TEST(OddRecordings, AreNotThoseThatTellNoScale) {
  const DifferentialDrive larger = scaled(kRobot, 1.06, 1.06, 1.0);
  std::vector<Recording> runs = one_run_of_each({larger, larger});
  test::GeneratorSettings g = test::under_motion_capture(larger, 0.0005, 0.05);
  Random random(5);
  runs.push_back(generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{-2.0 * std::sin(t), 2.0 * std::sin(t)};
      },
      random));
  runs.back().name = "on the spot.csv";
  EXPECT_TRUE(odd_recordings(runs, with_drawn_lengths()).empty());
}

TEST(OddRecordings, AreNotThoseWhoseLengthsAreHardlyKnown) {
  const auto own = [](double wheelbase_m, double error_m) {
    return std::vector<ParameterEstimate>{{"wheel_radius_left_m", "m", 0.1, 0.1, 1e-5, true},
                                          {"wheelbase_m", "m", 0.45, wheelbase_m, error_m, true}};
  };
  EXPECT_TRUE(odd_recordings({own(0.45, 0.001), own(0.47, 0.01), own(0.45, 0.001)}).empty());
  const std::vector<OddRecording> odd = odd_recordings({own(0.45, 0.001), own(0.47, 0.001), own(0.45, 0.001)});
  ASSERT_EQ(odd.size(), 1u);
  EXPECT_EQ(odd[0].index, 1u);
}

}  // namespace
}  // namespace odolab
