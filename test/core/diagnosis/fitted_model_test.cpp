#include "core/diagnosis/fitted_model.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

Diagnosis with_mounting_turned_by(double rad) {
  Diagnosis d;
  d.calibration.vehicle.kind = DifferentialDrive{};
  d.calibration.vehicle.truth.axle_T_tracked = {0.1, 0.0, rad};
  d.calibration.vehicle.truth.time_offset_s = 0.02;
  d.truth_clock_s = {{"one", 0.01}, {"two", 0.03}};
  return d;
}

Finding found(const std::string& effect, const std::string& parameter, double value) {
  Finding f;
  f.effect = effect;
  f.component = "vehicle";
  f.parameters = {{parameter, value, 0.0, ""}};
  return f;
}

TEST(FittedModel, DoesNotTurnTheMountingForACrawlThatIsTheWheels) {
  // a mounting turned by -0.03 shows a straight as a crawl of 0.03 to the left
  Diagnosis d = with_mounting_turned_by(-0.03);
  d.findings = {found("wheel_toe", "sideways_per_metre", 0.03)};
  const FittedModel model = model_of(d);
  EXPECT_NEAR(model.vehicle.truth.axle_T_tracked.heading_rad, 0.0, 1e-15);
  ASSERT_EQ(model.effects.size(), 1u);
  EXPECT_EQ(model.effects[0].active.effect, "wheel_toe");
}

TEST(FittedModel, KeepsEachRecordingsOwnClockWhereTheMeanIsAFindingToo) {
  Diagnosis d = with_mounting_turned_by(0.0);
  d.findings = {found("truth_time_offset", "offset_s", 0.02)};
  const FittedModel model = model_of(d);
  EXPECT_TRUE(model.effects_in("two").empty());
  EXPECT_DOUBLE_EQ(model.vehicle_in("two").truth.time_offset_s, 0.03);
  ASSERT_EQ(model.effects_in("another").size(), 1u);  // one that was not fitted: the mean is the best guess
}

}  // namespace
}  // namespace odolab
