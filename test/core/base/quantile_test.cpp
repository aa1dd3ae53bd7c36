#include "core/base/quantile.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(Quantile, StandsAtItsShareOfTheWayFromTheLeastToTheLargest) {
  const std::vector<double> v = {5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(quantile(v, 0.0), 1.0);
  EXPECT_EQ(quantile(v, 0.25), 2.0);
  EXPECT_EQ(quantile(v, 1.0), 5.0);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
}

TEST(Median, OfAnEvenNumberIsTheMeanOfBothInTheMiddle) {
  EXPECT_EQ(median({9.0, 1.0, 5.0}), 5.0);
  EXPECT_EQ(median({7.0, 1.0, 100.0, 3.0}), 5.0);
  EXPECT_EQ(median({}), 0.0);
}

}  // namespace
}  // namespace odolab
