#include "core/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

TEST(Random, HashesAsSplitMix64DoesInItsReference) {
  // First outputs of the reference implementation (S. Vigna, splitmix64.c) for the seed 0.
  EXPECT_EQ(mixed(0), 0xe220a8397b1dcdafULL);
  EXPECT_EQ(mixed(0x9e3779b97f4a7c15ULL), 0x6e789e6aa1b965f4ULL);
}

TEST(Random, GivesTheSameNumbersForTheSameSeedAndOthersForOthers) {
  Random a(5), b(5), c(6);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t x = a.next();
    EXPECT_EQ(x, b.next());
    differs = differs || x != c.next();
  }
  EXPECT_TRUE(differs);
  EXPECT_NE(seed_of_stream(1, 0), seed_of_stream(1, 1));
  EXPECT_NE(seed_of_stream(1, 0), seed_of_stream(2, 0));
}

TEST(Random, IsUniformAndNormalInItsMoments) {
  Random random(1);
  const int n = 200000;
  double u1 = 0, u2 = 0, n1 = 0, n2 = 0, n4 = 0, lag = 0, before = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    u1 += u;
    u2 += u * u;
    const double z = random.normal();
    n1 += z;
    n2 += z * z;
    n4 += z * z * z * z;
    lag += z * before;
    before = z;
  }
  // Five standard deviations of each mean: sqrt(variance / n) with variances 1/12, 4/45, 1, 2, 96 and 1.
  const double s = 5.0 / std::sqrt(static_cast<double>(n));
  EXPECT_NEAR(u1 / n, 0.5, s * std::sqrt(1.0 / 12));
  EXPECT_NEAR(u2 / n, 1.0 / 3, s * std::sqrt(4.0 / 45));
  EXPECT_NEAR(n1 / n, 0.0, s);
  EXPECT_NEAR(n2 / n, 1.0, s * std::sqrt(2.0));
  EXPECT_NEAR(n4 / n, 3.0, s * std::sqrt(96.0));
  EXPECT_NEAR(lag / n, 0.0, s);
}

}  // namespace
}  // namespace odolab
