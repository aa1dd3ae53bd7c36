#include "core/calibration/shape_guess.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibration/least_squares.h"
#include "test/support/known_drive.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// As a tracker of one marker records it.
Case without_headings() {
  CaseSettings settings;
  settings.runs = 3;
  settings.duration_s = 40.0;
  Case c = generated_case(settings, 8511);
  for (Recording& r : c.recordings)
    r.channels.erase(std::remove_if(r.channels.begin(), r.channels.end(),
                                    [](const Channel& channel) { return channel.name == "truth_heading_rad"; }),
                     r.channels.end());
  DifferentialDrive& drawn = std::get<DifferentialDrive>(c.nominal.kind);
  drawn.wheelbase_m = 0.95 * c.actual.wheelbase_m;
  drawn.wheel_radius_left_m = 1.03 * c.actual.wheel_radius_left_m;
  return c;
}

TEST(ShapeGuess, FindsRadiiAndWheelbaseWithoutHeadingsToAPercent) {
  const Case c = without_headings();
  std::vector<InnovationRun> runs;
  for (const Recording& r : c.recordings) runs.push_back(*innovation_run(r, c.nominal));
  const DifferentialDrive drawn = std::get<DifferentialDrive>(c.nominal.kind);
  const std::optional<ShapeGuess> guess = shape_guess(runs, drawn, c.nominal.truth);
  ASSERT_TRUE(guess);
  // A millimetre of truth over stretches of a metre, and a start for what is exact: a percent.
  EXPECT_NEAR(guess->drive.wheelbase_m, c.actual.wheelbase_m, 0.01 * c.actual.wheelbase_m);
  EXPECT_NEAR(guess->drive.wheel_radius_left_m, c.actual.wheel_radius_left_m, 0.01 * c.actual.wheel_radius_left_m);
  EXPECT_NEAR(guess->drive.wheel_radius_right_m, c.actual.wheel_radius_right_m, 0.01 * c.actual.wheel_radius_right_m);
}

TEST(ShapeGuess, LetsACalibrationWithoutHeadingsFindWhatOneWithThemDoes) {
  const Case c = without_headings();
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(fit) << fit.error().message();
  expect_holds(*fit, c.actual);
  for (const ParameterEstimate& p : fit->parameters) {
    if (p.name.rfind("wheel", 0) != 0) continue;
    EXPECT_LT(p.stderr_value, 1e-3 * p.value) << p.name;
  }
}

}  // namespace
}  // namespace odolab::test
