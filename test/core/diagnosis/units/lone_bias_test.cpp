#include "core/diagnosis/units/lone_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace odolab {
namespace {

constexpr double kA = 0.22e-3, kB = 0.26e-3, kLength = 0.3e-3, kAlike = 0.95;

// Angles at both ends of a link that err together, and its length.
GeometryFit geometry_with(double a_rad, double b_rad, double length_m) {
  GeometryFit fit;
  const double off[] = {a_rad, b_rad, length_m}, error[] = {kA, kB, kLength};
  const char* names[] = {"link_angle_a_offset_rad", "link_angle_b_offset_rad", "link_length_offset_m"};
  for (int k = 0; k < 3; ++k) {
    JointEstimate e;
    e.parameter.name = names[k];
    e.parameter.effect = k < 2 ? "link_angle_bias" : "link_length_bias";
    e.value = off[k];
    e.stderr_value = error[k];
    e.determined = true;
    fit.joints.push_back(e);
  }
  fit.covariance = Eigen::Vector3d(kA * kA, kB * kB, kLength * kLength).asDiagonal();
  fit.covariance(0, 1) = fit.covariance(1, 0) = kAlike * kA * kB;
  return fit;
}

// Both angles are off by chance in the direction in which they err together: what that is of one tells it of the other.
TEST(LoneBias, IsThatOfTheEncoderThatAloneSaysWhatAllSay) {
  const double by_chance_rad = 0.2e-3;
  const GeometryFit fit = geometry_with(-by_chance_rad, 1.75e-3, 0.1e-3);
  const std::optional<LoneBias> lone = lone_bias(fit);
  ASSERT_TRUE(lone);
  EXPECT_EQ(lone->joint, 1u);
  EXPECT_NEAR(lone->off, 1.75e-3 + kAlike * kB / kA * by_chance_rad, 1e-12);  // of two that are normal, given the other
  EXPECT_NEAR(lone->stderr_value, kB * std::sqrt(1.0 - kAlike * kAlike), 1e-12);
  EXPECT_EQ(lone->others, (std::vector<std::string>{"link_angle_a_offset_rad", "link_length_offset_m"}));
}

TEST(LoneBias, IsNoneWhereTwoAreOffOrNoneIs) {
  EXPECT_FALSE(lone_bias(geometry_with(-2e-3, 2e-3, 0.0)));
  EXPECT_FALSE(lone_bias(geometry_with(0.0, 0.0, 0.0)));
}

// Their difference is known far better than either: both ends are as likely.
TEST(LoneBias, MayBeThatOfTheOtherEndWhereOnlyTheDifferenceShows) {
  const std::optional<LoneBias> lone = lone_bias(geometry_with(-0.4e-3, 0.4e-3, 0.0));
  ASSERT_TRUE(lone);
  ASSERT_EQ(lone->instead.size(), 1u);
  EXPECT_EQ(lone->joint + lone->instead[0].joint, 1u);
}

// All pivots read more by what the body's x axis is turned; beyond that one does, and the mean of the two others, each
// with its own error, says how much: s^2 (1 + 1/2).
TEST(LoneBias, OfAPivotIsWhatItReadsMoreThanTheOthers) {
  constexpr double kOwn = 1e-4, kAll = 6e-4, kTurned = 5e-4, kOff = 2.7e-3;
  GeometryFit fit;
  for (int k = 0; k < 3; ++k) {
    JointEstimate e;
    e.parameter.name = "castor[" + std::to_string(k + 1) + "].pivot_encoder_offset_rad";
    e.parameter.effect = "pivot_angle_bias";
    e.value = kTurned + (k == 2 ? kOff : k == 1 ? kOwn : -kOwn);
    e.determined = true;
    fit.joints.push_back(e);
  }
  fit.covariance = kOwn * kOwn * Eigen::Matrix3d::Identity() + kAll * kAll * Eigen::Matrix3d::Ones();
  const std::optional<LoneBias> lone = lone_bias(fit);
  ASSERT_TRUE(lone);
  EXPECT_EQ(lone->joint, 2u);
  EXPECT_TRUE(lone->instead.empty());
  EXPECT_NEAR(lone->off, kOff, 1e-9);
  EXPECT_NEAR(lone->stderr_value, kOwn * std::sqrt(1.5), 1e-9);
  EXPECT_NEAR(lone->turned_rad, kTurned, 1e-9);
  fit.joints.pop_back();
  fit.covariance = Eigen::Matrix2d(fit.covariance.topLeftCorner<2, 2>());
  EXPECT_FALSE(lone_bias(fit));  // of two either may be off
}

TEST(LoneBias, IsNotAskedForWhereAnOffsetIsNotKnownOrHowTheyErr) {
  GeometryFit fit = geometry_with(0.0, 3e-3, 0.0);
  ASSERT_TRUE(lone_bias(fit));
  fit.joints[0].determined = false;
  EXPECT_FALSE(lone_bias(fit));
  fit = geometry_with(0.0, 3e-3, 0.0);
  fit.covariance.resize(0, 0);
  EXPECT_FALSE(lone_bias(fit));
}

}  // namespace
}  // namespace odolab
