#include "core/base/fixed_point.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace odolab {
namespace {

// A linear map is solved exactly once its steps span its space, as by GMRES (Walker and Ni 2011): three numbers, three
// changes, which the fourth question to the map completes.
TEST(FixedPoint, OfALinearMapThatConvergesByATwentiethIsFoundOnceItsStepsSpanItsSpace) {
  Eigen::Matrix3d by;
  by << 0.95, 0.02, 0.0, -0.02, 0.9, 0.1, 0.0, 0.05, 0.3;
  const Eigen::Vector3d offset{1.0, -2.0, 0.5};
  const Eigen::Vector3d fixed = (Eigen::Matrix3d::Identity() - by).lu().solve(offset);
  const auto map = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return by * x + offset; };
  FixedPoint point;
  Eigen::VectorXd accelerated = Eigen::Vector3d::Zero(), plain = accelerated;
  for (int k = 0; k < 4; ++k) {
    accelerated = point.next(accelerated, map(accelerated));
    plain = map(plain);
  }
  EXPECT_LT((accelerated - fixed).norm(), 1e-9 * fixed.norm());  // rounding
  EXPECT_GT((plain - fixed).norm(), 0.5 * fixed.norm());         // 0.95^4 of the way is left
}

}  // namespace
}  // namespace odolab
