#include "core/base/result.h"

#include <gtest/gtest.h>

#include "core/base/progress.h"

namespace odolab {
namespace {

TEST(Result, HoldsAValueOrTheReasonWhyNot) {
  const Result<int> good = 3;
  EXPECT_TRUE(good.ok());
  EXPECT_EQ(*good, 3);
  const Result<int> bad = Error{"labmate.toml:5: wheelbase_m", "0", "a length above 0 m"};
  EXPECT_FALSE(bad);
  EXPECT_EQ(bad.error().message(), "labmate.toml:5: wheelbase_m: found 0, expected a length above 0 m");
}

TEST(Error, LeavesOutWhatItDoesNotKnow) {
  EXPECT_EQ((Error{"file", "", "a header"}).message(), "file: expected a header");
  EXPECT_EQ((Error{"file", "nothing", ""}).message(), "file: found nothing");
}

TEST(Progress, GoesOnWhereNobodyListens) {
  EXPECT_TRUE(goes_on({}, 0.5));
  double heard = 0.0;
  EXPECT_FALSE(goes_on(
      [&](double share) {
        heard = share;
        return false;
      },
      0.5));
  EXPECT_EQ(heard, 0.5);
}

}  // namespace
}  // namespace odolab
