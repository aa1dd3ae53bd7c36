#include "core/diagnosis/generic/lagging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/diagnosis/diagnosis.h"
#include "test/support/calibrated_model.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// A marker that falls behind by so much of each acceleration, ahead and aside: the square of a mast's period over 2 pi.
std::vector<Recording> under_a_mast(double behind_s2, double truth_noise_m) {
  Random random(58);
  test::GeneratorSettings g = test::under_motion_capture({0.08, 0.08, 0.4}, 0.0001, 0.02, truth_noise_m, 0.0005);
  g.duration_s = 20.0;
  g.counts = false;
  const auto sways = [&](int) {
    struct Before {
      double speed_mps = 0.0;
      Vec2 off;
    };
    return [&, before = std::make_shared<Before>()](test::InjectedStep& s) {
      const double speed_mps = 0.5 * (s.left_m + s.right_m) / s.dt_s,
                   turning_radps = (s.right_m - s.left_m) / g.drive.wheelbase_m / s.dt_s;
      const Vec2 acceleration{(speed_mps - before->speed_mps) / s.dt_s, speed_mps * turning_radps};
      const Vec2 off = -behind_s2 * rotated(acceleration, s.pose.heading_rad);
      s.room_m = s.room_m + off - before->off;
      *before = {speed_mps, off};
    };
  };
  return test::three_runs(
      g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, sways);
}

// Of a second: 25 mm behind for each m/s2.
TEST(Lagging, ShowsAMastThatBends) {
  const Diagnosis d = diagnose(under_a_mast(0.025, 0.001), {}, Vehicle{}).value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_EQ(d.findings.front().where.regime,
            "marker, ahead and aside [s2] that depends on acceleration, as if its mast bent");
}

// Wheels that are read each 0.02 s may go otherwise between two readings: 0.4 mm for each m/s2 are theirs.
TEST(Lagging, LeavesTheSquareOfAReadingIntervalToTheReadings) {
  for (const double behind_s2 : {0.0002, 0.0007}) {
    JointModel joint = test::calibrated_model(under_a_mast(behind_s2, 0.00003), Vehicle{});
    joint.fit_noise_and_all();
    joint.linearise();
    EXPECT_EQ(lagging_tests(AskedModel(joint), 1.0)[1].p_value<0.005, behind_s2> 0.0004) << behind_s2;
  }
}

}  // namespace
}  // namespace odolab
