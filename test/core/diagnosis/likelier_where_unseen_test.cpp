#include <gtest/gtest.h>

#include "core/diagnosis/proof.h"

namespace odolab {
namespace {

Predicted predicted(double minus_two_log_likelihood, int scalars) {
  Predicted p;
  p.unseen.emplace();
  p.unseen->of_model.resize(1);
  p.unseen->minus_two_log_likelihood = {minus_two_log_likelihood};
  p.unseen->scalars = {scalars};
  return p;
}

TEST(LikelierWhereUnseen, IsWhatSaysMoreOfTheSameSamples) {
  EXPECT_DOUBLE_EQ(likelier_where_unseen(predicted(-30100.0, 3000), predicted(-30000.0, 3000)), 100.0);
}

// A filter that starts anew once more says nothing of five samples, each of which is some ten times three.
TEST(LikelierWhereUnseen, IsNothingThatSaysAsMuchOfEachSampleAndHasFewerOfThem) {
  const Predicted all = predicted(-30000.0, 3000), fewer = predicted(-29850.0, 2985);
  EXPECT_NEAR(likelier_where_unseen(fewer, all), 0.0, 1e-9);
  EXPECT_NEAR(likelier_where_unseen(all, fewer), 0.0, 1e-9);
  EXPECT_EQ(denied_where_unseen(fewer, all, true).by_likelihood, 0.0);
}

}  // namespace
}  // namespace odolab
