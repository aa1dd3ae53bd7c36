#include "core/base/chi_square.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace odolab
