#include "core/base/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

TEST(ChiSquareTail, AgreesWithPublishedQuantiles) {
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(9.210, 2), 0.01, 1e-4);
  EXPECT_NEAR(chi_square_tail(11.345, 3), 0.01, 1e-4);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(19.675, 11), 0.05, 1e-4);
}

// Quantiles of F(2, 60) and F(4, 30), times their first freedom.
TEST(ChiSquareTail, IsFishersFWhereTheScaleCameFromFewBatches) {
  EXPECT_NEAR(scaled_chi_square_tail(2 * 3.150, 2, 60.0), 0.05, 1e-4);
  EXPECT_NEAR(scaled_chi_square_tail(4 * 4.018, 4, 30.0), 0.01, 1e-4);
  // With many batches it is chi-square, but for a share of x^2 / (4 batches): 0.4 % of 0.01.
  EXPECT_NEAR(scaled_chi_square_tail(9.210, 2, 5e3), chi_square_tail(9.210, 2), 6e-5);
}

// Of freedom 2 it is a power. A series that ended after ten thousand terms had made 0.017 of 0.99995.
TEST(ChiSquareTail, IsFishersFOfLittleToo) {
  for (const double batches : {3.0, 60.0, 1000.0, 9000.0})
    for (const double x : {1e-4, 0.01, 0.5, 3.0, 30.0})
      EXPECT_NEAR(scaled_chi_square_tail(x, 2, batches), std::pow(batches / (batches + x), 0.5 * batches), 1e-9)
          << x << " of " << batches;
}

}  // namespace
}  // namespace odolab
