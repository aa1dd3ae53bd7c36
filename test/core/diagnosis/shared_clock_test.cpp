#include "core/diagnosis/model/shared_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

Eigen::MatrixXd independent(std::initializer_list<double> stderr_s) {
  Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(stderr_s.size()), static_cast<Eigen::Index>(stderr_s.size()));
  Eigen::Index k = 0;
  for (const double s : stderr_s) covariance(k, k) = s * s, ++k;
  return covariance;
}

TEST(SharedClock, IsNotMovedByARecordingThatKnowsNothingOfIts) {
  const SharedClock c = shared_clock({0.0005, -0.0005, 0.15}, independent({0.001, 0.001, 0.2}));
  EXPECT_NEAR(c.offset_s, 0.0, 1e-5);
  EXPECT_NEAR(c.stderr_s, 0.001 / std::sqrt(2.0), 1e-5);
}

// Clocks that each is sure of differ by what they were set to: the mean of three is known by their own scatter.
TEST(SharedClock, IsAsUncertainAsClocksThatWereSetByHandDiffer) {
  const SharedClock c = shared_clock({0.03, -0.05, 0.08}, independent({1e-4, 1e-4, 1e-4}));
  EXPECT_NEAR(c.offset_s, 0.02, 1e-5);
  const double scatter = std::sqrt((0.01 * 0.01 + 0.07 * 0.07 + 0.06 * 0.06) / 2.0);
  EXPECT_NEAR(c.stderr_s, scatter / std::sqrt(3.0), 1e-4);
}

TEST(SharedClock, OfOneRecordingIsItsOwn) {
  const SharedClock c = shared_clock({0.012}, independent({0.0005}));
  EXPECT_DOUBLE_EQ(c.offset_s, 0.012);
  EXPECT_DOUBLE_EQ(c.stderr_s, 0.0005);
}

}  // namespace
}  // namespace odolab
