#include "core/calibration/late_truth.h"

#include <gtest/gtest.h>

#include "core/calibration/least_squares.h"
#include "test/support/missing_physics.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

Case late_case(double late_s, CaseSettings::Truth truth = CaseSettings::Truth::mocap) {
  CaseSettings settings;
  settings.runs = 2;
  settings.duration_s = 50.0;
  settings.truth = truth;
  Case c = generated_case(settings, 8411);
  for (Recording& r : c.recordings) r = with_truths_clock(r, late_s, 0.0);
  return c;
}

TEST(LateTruth, OfSecondsIsToldFromHeadingsInDegreesAndMendedByTheVehiclesFile) {
  for (const double late_s : {2.0, -3.5, 11.0}) {
    const Case c = late_case(late_s);
    const Result<LeastSquaresCalibration> refused = calibrate_least_squares(c.recordings, c.nominal);
    ASSERT_FALSE(refused) << late_s;
    char says[40];
    std::snprintf(says, sizeof says, "time_offset_s = %.1f", late_s);
    EXPECT_NE(refused.error().message().find(says), std::string::npos) << refused.error().message();
    EXPECT_EQ(refused.error().expected, std::string("both by one clock, or truth_mounting.") + says +
                                            " in the vehicle's file");

    Vehicle told = c.nominal;
    told.truth.time_offset_s = late_s;
    const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, told);
    ASSERT_TRUE(fit) << fit.error().message();
    // The truth is taken every hundredth of a second or so, and clocks come out to a few thousandths.
    for (double offset_s : fit->time_offset_s) EXPECT_NEAR(offset_s, late_s, 0.01);
  }
}

TEST(LateTruth, IsNotSuspectedWhereTheClocksAgreeToTenths) {
  const Case c = late_case(0.2);
  std::vector<InnovationRun> runs;
  for (const Recording& r : c.recordings) runs.push_back(*innovation_run(r, c.nominal));
  EXPECT_FALSE(late_truth_s(runs));
}

}  // namespace
}  // namespace odolab::test
