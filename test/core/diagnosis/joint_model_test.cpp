#include "core/diagnosis/model/joint_model.h"

#include <gtest/gtest.h>

#include "core/calibration/least_squares.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// The wheelbase takes up most of a scrub: the likelihood's own difference is then ruled by what a wheelbase a little
// larger or smaller does to the model's covariance, and may be negative.
TEST(JointModel, GainsByAnEffectThatCalibrationNearlyTakesUpWhatItsScorePromises) {
  CaseSettings settings;
  settings.effect = "turn_scrub";
  settings.size = 4.0;
  settings.runs = 3;
  settings.duration_s = 40.0;
  const Case c = generated_case(settings, 7311);
  const Result<LeastSquaresCalibration> calibration = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(calibration);
  std::vector<InnovationRun> runs;
  for (const Recording& r : c.recordings) {
    Result<InnovationRun> run = innovation_run(r, c.nominal);
    ASSERT_TRUE(run);
    runs.push_back(std::move(*run));
  }
  JointModel joint(std::move(runs), std::vector<char>(c.recordings.size(), 0), *calibration, c.nominal);
  joint.fit(4);
  EXPECT_NEAR(joint.fit(2), 0.0, 0.1) << "fitted already";
  for (const Effect& e : catalogue()) {
    if (e.name != "turn_scrub") continue;
    const CandidateTest t = joint.test(joint.columns_of(e, {0.04}));
    joint.accepted.push_back({&e, {0.04}, {0.0}, {}});
    // The score is that at no scrub; a scrub of 4 % per rad/s is not quite linear.
    EXPECT_NEAR(joint.fit(4), t.statistic, 0.15 * t.statistic);
    EXPECT_GT(t.statistic, 100.0);
  }
}

}  // namespace
}  // namespace odolab::test
