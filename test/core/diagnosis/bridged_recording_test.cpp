#include "core/diagnosis/quality/bridged_recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibration/external.h"
#include "core/odometry/prediction.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// A minute of a robot whose counters begin anew after half of it, and the same without.
Recording minute_of(bool restarts) {
  test::GeneratorSettings g = test::under_motion_capture({0.0812, 0.0805, 0.402}, 0.001, 0.004);
  g.duration_s = 60.0;
  Random random(12);
  Recording r = generated(g, test::varied_driving(random, g.duration_s), random);
  r.name = "minute.csv";
  if (!restarts) return r;
  for (Channel& c : r.channels) {
    if (c.name.find("_wheel_rad") == std::string::npos) continue;
    double from_rad = std::nan("");
    for (std::size_t i = 0; i < r.time_s.size(); ++i) {
      if (r.time_s[i] < 30.0 || std::isnan(c.values[i])) continue;
      if (std::isnan(from_rad)) from_rad = c.values[i];
      c.values[i] -= from_rad;
    }
  }
  return r;
}

Vehicle as_drawn() {
  Vehicle v;
  v.kind = DifferentialDrive{0.08, 0.08, 0.4};
  return v;
}

TEST(BridgedRecording, IsTheOneThatWasGivenWhereNothingIsAtFault) {
  const Recording r = minute_of(false);
  const BridgedRecording sound = bridged_recording(r, as_drawn(), Looks::at_truth_too);
  EXPECT_TRUE(sound.said.empty());
  EXPECT_TRUE(sound.left_out_s.empty());
  EXPECT_EQ(sound.recording.channels.size(), r.channels.size());
}

TEST(BridgedRecording, CalibratesAsIfItsCountersHadGoneOn) {
  const BridgedRecording sound = bridged_recording(minute_of(true), as_drawn(), Looks::at_truth_too);
  ASSERT_FALSE(sound.said.empty());
  ASSERT_FALSE(sound.left_out_s.empty());
  EXPECT_NEAR(sound.left_out_s.front().first, 30.0, 0.2);
  LeastSquaresOptions how;
  how.left_out = {sound.left_out_s};
  const auto found = calibrate_externally({sound.recording}, as_drawn(), {}, how);
  ASSERT_TRUE(found) << found.error().message();
  const double truth[] = {0.0812, 0.0805, 0.402};
  for (int k = 0; k < 3; ++k) {
    const ParameterEstimate& p = found->parts[0].calibration.parameters[static_cast<std::size_t>(k)];
    EXPECT_NEAR(p.value, truth[k], 4.0 * p.stderr_value) << p.name;
    EXPECT_LT(p.stderr_value, 1e-3 * truth[k]) << p.name;
  }
}

// Stamps that tremble make other rows; the truth stays in its own.
TEST(BridgedRecording, HasAWholeTruthThoughStampsAreEvened) {
  Recording r = minute_of(true);
  Random random(3);
  const Channel& left = *r.channel("left_wheel_rad");
  for (std::size_t i = 1; i + 1 < r.time_s.size(); ++i)
    if (!std::isnan(left.values[i])) r.time_s[i] += 0.001 * std::clamp(random.normal(), -2.0, 2.0);
  for (const Looks looks : {Looks::at_wheels_alone, Looks::at_truth_too}) {
    const BridgedRecording sound = bridged_recording(r, as_drawn(), looks);
    ASSERT_FALSE(sound.said.empty());
    EXPECT_TRUE(problems_in(sound.recording).empty());
    EXPECT_EQ(truth_samples(sound.recording).size(), truth_samples(r).size());
  }
}

// By the wheels alone: the truth is not looked at.
TEST(BridgedRecording, IsPredictedAsIfItsCountersHadGoneOn) {
  const BridgedRecording sound = bridged_recording(minute_of(true), as_drawn(), Looks::at_wheels_alone);
  ASSERT_FALSE(sound.said.empty());
  const Track bridged = predicted_track(sound.recording, as_drawn()).value(),
              whole = predicted_track(minute_of(false), as_drawn()).value();
  const auto error = track_error(bridged, whole);
  ASSERT_TRUE(error);
  EXPECT_LT(error->position_rms_m, 0.005);  // of one reading's way, some 10 mm in one stretch of a metre among dozens
}

}  // namespace
}  // namespace odolab
