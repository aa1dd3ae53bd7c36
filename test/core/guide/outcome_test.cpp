#include "core/guide/outcome.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(GuideOutcome, NamesTheNumbersOfACalibrationFromTheInsideInWords) {
  GuideSession session;
  session.kind = GuideKind::linked;
  session.vehicle.kind = Clapper{};
  InternalCalibration internal;
  internal.vehicle = session.vehicle;
  internal.parameters = {{"truck_a.wheel_radius_left_m", "m", 0.075, 0.0751, 1e-5, true},
                         {"link_angle_b_offset_rad", "rad", 0.0, 0.01, 7e-4, true},
                         {"castor[2].offset_m", "m", 0.05, 0.05, 0.0, false}};
  const GuideOutcome out = outcome_of(session, &internal, {});
  ASSERT_EQ(out.settings.size(), 3u);
  EXPECT_EQ(out.settings[0].words, "truck A, wheel radius left");
  EXPECT_EQ(out.settings[1].words, "link angle B offset");
  EXPECT_EQ(out.settings[2].words, "castor 2, offset");
  EXPECT_EQ(out.settings[0].key, "truck_a.wheel_radius_left_m");
}

// A metre straight ahead, of which the truth looks at the first half: there nothing errs. Held against where the robot
// came to in the end, it had been half a metre off.
TEST(GuideOutcome, HoldsATruthThatEndsEarlyAgainstWhereTheRobotWasThen) {
  constexpr int kReadings = 101;
  const Vehicle vehicle;
  const double radius_m = std::get<DifferentialDrive>(vehicle.kind).wheel_radius_left_m;
  Recording recording;
  for (int i = 0; i < kReadings; ++i) recording.time_s.push_back(0.1 * i);
  for (const char* name : {"left_wheel_rad", "right_wheel_rad", "truth_x_m", "truth_y_m", "truth_heading_rad"})
    recording.add_channel(name);
  for (std::size_t i = 0; i < kReadings; ++i) {
    const double way_m = 0.01 * static_cast<double>(i);
    recording.channels[0].values[i] = recording.channels[1].values[i] = way_m / radius_m;
    if (2 * i >= kReadings) continue;
    recording.channels[2].values[i] = way_m;
    recording.channels[3].values[i] = recording.channels[4].values[i] = 0.0;
  }
  const Result<HeldOutError> error = held_out_error(recording, vehicle, vehicle);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->before_m, 0.0, 1e-9);
  EXPECT_NEAR(error->after_m, 0.0, 1e-9);
}

TEST(Guide, SaysInWordsWhatVehicleItIsNotFor) {
  Vehicle vehicle;
  vehicle.kind = Clapper{};
  EXPECT_EQ(why_not(guide_of(GuideKind::umbmark), vehicle),
            "This guide is for differential drives; the vehicle is another: two trucks on a compliant link.");
  EXPECT_EQ(why_not(guide_of(GuideKind::linked), vehicle), "");
}

}  // namespace
}  // namespace odolab
