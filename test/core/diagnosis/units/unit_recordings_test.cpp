#include "core/diagnosis/units/unit_recordings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/units/outside_truth.h"
#include "core/odometry/prediction.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

TEST(UnitRecordings, FollowTheUnitWithTheTruthsNoiseAndTheRoundingOfTheJoints) {
  LinkedRunSettings s;
  s.truth_m = s.truth_rad = s.wheel_noise = 0.0;
  Clapper actual;
  actual.link_angle_resolution_rad = actual.link_length_resolution_m = 0.0;
  const Recording run = linked_run(actual, s, 1);
  const Vehicle vehicle = vehicle_of(actual);
  const Recording of_b = recording_of_unit(run, unit_samples(run, vehicle), tracked_poses(run), vehicle, 1, 0.0, true);
  const Result<Track> reckoned = predicted_track(of_b, vehicle_of_unit(units_of(vehicle)[1], vehicle));
  ASSERT_TRUE(reckoned);
  const auto error = track_error(*reckoned, truth_track(of_b));
  ASSERT_TRUE(error);
  EXPECT_LT(error->position_rms_m, 3e-4);  // wheels of 2000 counts: 0.24 mm each, and no more
}

// The truth comes as often as the readings and between them: what is made of two of its samples would share each of
// them with the next, and errors that are shared look like less noise than there is.
TEST(UnitRecordings, HaveTheTruthsNoiseFreshInEachSample) {
  LinkedRunSettings s;
  s.truth_m = s.wheel_noise = 0.0;
  s.truth_rad = 0.005;
  Clapper actual;
  actual.link_angle_resolution_rad = actual.link_length_resolution_m = 0.0;
  const Recording run = linked_run(actual, s, 1);
  const Vehicle vehicle = vehicle_of(actual);
  constexpr double kHalfAReading_s = 0.02;
  const Recording of_b =
      recording_of_unit(run, unit_samples(run, vehicle), tracked_poses(run), vehicle, 1, kHalfAReading_s, true);
  const Track truth = truth_track(of_b);
  double squares = 0.0;
  for (std::size_t i = 3; i < truth.size(); ++i) {
    const auto heading = [&](std::size_t back) { return truth[i - back].pose.heading_rad; };
    squares += std::pow(wrapped(heading(0) - 3.0 * heading(1) + 3.0 * heading(2) - heading(3)), 2);
  }
  // Third differences of white noise have 1 + 9 + 9 + 1 times its variance, and the motion next to none; 5 % is three
  // standard errors of 750 of them.
  const double scatter_rad = std::sqrt(squares / 20.0 / static_cast<double>(truth.size() - 3));
  EXPECT_NEAR(scatter_rad, s.truth_rad, 0.15 * s.truth_rad);
}

}  // namespace
}  // namespace odolab::test
