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

TEST(Guide, SaysInWordsWhatVehicleItIsNotFor) {
  Vehicle vehicle;
  vehicle.kind = Clapper{};
  EXPECT_EQ(why_not(guide_of(GuideKind::umbmark), vehicle),
            "This guide is for differential drives; the vehicle is another: two trucks on a compliant link.");
  EXPECT_EQ(why_not(guide_of(GuideKind::linked), vehicle), "");
}

}  // namespace
}  // namespace odolab
