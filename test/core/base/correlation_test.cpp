#include "core/base/correlation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

// x' = memory x + e, of variance one.
std::vector<double> autoregressive(double memory, int values, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x = {random.normal()};
  while (static_cast<int>(x.size()) < values)
    x.push_back(memory * x.back() + std::sqrt(1.0 - memory * memory) * random.normal());
  return x;
}

// The variance of the sum of a first-order autoregression is (1 + memory) / (1 - memory) times that of white noise. Of
// 20 000 values the sum over 20 lags is known to 4 standard deviations of sqrt(2 (2 20 + 1) / 20000).
TEST(SumWidenedByCorrelation, IsThatOfAnAutoregressionWhichHasAFormula) {
  for (const double memory : {0.0, 0.3, 0.6}) {
    const double expected = (1.0 + memory) / (1.0 - memory);
    EXPECT_NEAR(sum_widened_by_correlation({autoregressive(memory, 20000, 5)}), expected, 0.26 * expected) << memory;
  }
}

TEST(SumWidenedByCorrelation, IsOneOfWhatComesBackTheOtherWay) {
  EXPECT_EQ(sum_widened_by_correlation({autoregressive(-0.6, 5000, 6)}), 1.0);
}

TEST(SumWidenedByCorrelation, IsOneWhereThereIsNothing) {
  EXPECT_EQ(sum_widened_by_correlation({}), 1.0);
  EXPECT_EQ(sum_widened_by_correlation({{}, {0.0}}), 1.0);
}

// One stretch's end has nothing to do with the next one's beginning: twins are tied to each other alone.
TEST(SumWidenedByCorrelation, DoesNotReachFromOneStretchIntoAnother) {
  Random random(7);
  std::vector<std::vector<double>> twins;
  for (int n = 0; n < 100; ++n) twins.emplace_back(2, random.normal());
  EXPECT_NEAR(sum_widened_by_correlation(twins), 2.0, 1e-12);
}

}  // namespace
}  // namespace odolab
