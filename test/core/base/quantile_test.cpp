#include "core/base/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

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

TEST(ScatterAboutZero, OfNormalNumbersIsTheirDeviationWhateverATwentiethOfThemSays) {
  constexpr double kDeviation = 0.3;
  constexpr int kNumbers = 4000;
  Random random(1);
  std::vector<double> values;
  for (int i = 0; i < kNumbers; ++i) values.push_back(i % 20 == 0 ? -1e6 : kDeviation * random.normal());
  // The median of sizes is then that of the 0.526th: 1.062 times as large. Its own error: 1.17 / sqrt(n).
  EXPECT_NEAR(scatter_about_zero(values), 1.062 * kDeviation, 4.0 * 1.17 / std::sqrt(kNumbers) * kDeviation);
  EXPECT_EQ(scatter_about_zero({}), 0.0);
}

}  // namespace
}  // namespace odolab
