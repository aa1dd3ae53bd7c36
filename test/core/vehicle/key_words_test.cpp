#include "core/vehicle/key_words.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(KeyWords, CallTrucksByTheirLetterAndCastorsByTheirNumber) {
  EXPECT_EQ(part_words("truck_a"), "truck A");
  EXPECT_EQ(part_words("truck_b"), "truck B");
  EXPECT_EQ(part_words("castor2"), "castor 2");
  EXPECT_EQ(part_words("castor[12]"), "castor 12");
  EXPECT_EQ(part_words("left_wheel"), "left wheel");
  EXPECT_EQ(part_words("trailer"), "trailer");
}

TEST(KeyWords, LeaveOutAParametersUnit) {
  EXPECT_EQ(parameter_words("wheel_radius_left_m"), "wheel radius left");
  EXPECT_EQ(parameter_words("truck_a.wheelbase_m"), "truck A, wheelbase");
  EXPECT_EQ(parameter_words("castor[1].pivot_encoder_offset_rad"), "castor 1, pivot encoder offset");
  EXPECT_EQ(parameter_words("link_angle_a_offset_rad"), "link angle A offset");
  EXPECT_EQ(parameter_words("truth_mounting.x_m"), "truth mounting, x");
  EXPECT_EQ(parameter_words("above_radps"), "above");
  EXPECT_EQ(parameter_words("slip_factor"), "slip factor");
}

TEST(KeyWords, KeepTheNumberOfOneOfSeveral) {
  EXPECT_EQ(parameter_words("phase_rad_2"), "phase 2");
  EXPECT_EQ(parameter_words("rate_1"), "rate 1");
}

TEST(KeyWords, CallWhatOnlyHasAUnitAnAmount) {
  EXPECT_EQ(parameter_words("per_radps"), "amount");
  EXPECT_EQ(parameter_words("rad_per_m"), "amount");
  EXPECT_EQ(parameter_words("m_per_s_per_mps2"), "amount");
  EXPECT_EQ(parameter_words("radius_change_m_per_mps2"), "radius change");
  EXPECT_EQ(parameter_words("sideways_per_metre"), "sideways per metre");
}

}  // namespace
}  // namespace odolab
