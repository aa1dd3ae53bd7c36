#include "core/calibration/miscounted_wheel.h"

#include <gtest/gtest.h>

#include "core/io/verdict_sentence.h"
#include "test/support/drive_generator.h"

namespace odolab::test {
namespace {

LeastSquaresCalibration of_radii(double left_m, double right_m) {
  LeastSquaresCalibration c;
  c.parameters = {{"wheel_radius_left_m", "m", 0.0625, left_m, 1e-5, true},
                  {"wheel_radius_right_m", "m", 0.0625, right_m, 1e-5, true}};
  return c;
}

TEST(MiscountedWheel, IsTheOneThatAloneSeemsTwoOrFourTimesAsLargeOrSmall) {
  const std::vector<MiscountedWheel> twice = miscounted_wheels(of_radii(0.0626, 0.1249));
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_EQ(in_words(twice[0]),
            "The right wheel seems twice as large as the file says: its encoder counts half of what the file says "
            "(one channel, or other settings of one side)");
  const std::vector<MiscountedWheel> quarter = miscounted_wheels(of_radii(0.01566, 0.0624));
  ASSERT_EQ(quarter.size(), 1u);
  EXPECT_EQ(in_words(quarter[0]),
            "The left wheel seems a quarter as large as the file says: its encoder counts four times what the file "
            "says (one channel, or other settings of one side)");
}

TEST(MiscountedWheel, IsNoneOfAWheelThatIsOnlyLargeAndOfTwoThatAreOffAlike) {
  EXPECT_TRUE(miscounted_wheels(of_radii(0.0626, 0.118)).empty());
  EXPECT_TRUE(miscounted_wheels(of_radii(0.125, 0.125)).empty());
  LeastSquaresCalibration open = of_radii(0.0626, 0.125);
  open.scale_is_open = true;  // it may as well be the other one
  EXPECT_TRUE(miscounted_wheels(open).empty());
}

TEST(MiscountedWheel, IsSaidInTheVerdictAndInTheWarningOfItsRadius) {
  Random random(3);
  GeneratorSettings g;
  g.duration_s = 60.0;
  g.drive = {0.0750, 0.1502, 0.34};  // counted by one channel
  g.truth_position_noise_m = 0.001;
  const Recording driven = generated(g, rich_driving, random);
  const Result<LeastSquaresCalibration> c = calibrate_least_squares({driven}, Vehicle{});
  ASSERT_TRUE(c);
  bool is_said = false;
  for (const std::string& w : c->warnings)
    is_said = is_said || (w.rfind("wheel_radius_right_m: 100 % away", 0) == 0 &&
                          w.find("its encoder counts half of what the file says") != std::string::npos);
  EXPECT_TRUE(is_said);
  Diagnosis d;
  d.verdict = Verdict::nothing_missing;
  d.calibration = *c;
  EXPECT_NE(verdict_sentence(d).find("The right wheel seems twice as large"), std::string::npos) << verdict_sentence(d);
}

}  // namespace
}  // namespace odolab::test
