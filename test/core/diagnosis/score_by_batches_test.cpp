#include "core/diagnosis/model/score_by_batches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab::test {
namespace {

constexpr int kOfBatches = 20;

// Independent scores of batches that hold as much information each, wider than that by a factor in variance.
ScoreByBatches drawn_score(double inflation, Random& random) {
  ScoreByBatches score;
  for (int n = 0; n < kOfBatches; ++n) score.add(std::sqrt(inflation) * random.normal(), 1.0);
  score.finish();
  return score;
}

std::vector<ScoreByBatches> drawn_scores(const std::vector<double>& inflations, Random& random) {
  std::vector<ScoreByBatches> scores;
  for (double inflation : inflations) scores.push_back(drawn_score(inflation, random));
  return scores;
}

// The variance of a sample is unbiased, and that of its mean over the draws is 2 / (20 - 1) / 4000.
TEST(ScoreByBatches, ScatterInTheMeanByTheirInflation) {
  constexpr int kDraws = 4000;
  Random random(11);
  double sum = 0.0;
  for (int n = 0; n < kDraws; ++n) sum += drawn_score(2.5, random).scatter;
  EXPECT_NEAR(sum / kDraws, 2.5, 4.0 * 2.5 * std::sqrt(2.0 / (kOfBatches - 1) / kDraws));
}

// Kish's effective number: batches that hold nothing count for none, equal ones for one each.
TEST(ScoreByBatches, CountTheBatchesThatMatter) {
  ScoreByBatches score;
  for (int n = 0; n < 30; ++n) score.add(n % 3 == 0 ? 1.0 : 0.0, n % 3 == 0 ? 2.0 : 0.0);
  score.finish();
  EXPECT_DOUBLE_EQ(score.count, 10.0);
  EXPECT_DOUBLE_EQ(score.scatter, 0.0);  // each batch says the same
}

TEST(ScoreByBatches, AreCalledWhiteWhereTheyScatterAsChanceHasIt) {
  constexpr int kDraws = 400;
  Random random(12);
  int nearly_all = 0;
  for (int n = 0; n < kDraws; ++n)
    nearly_all += batches_of_prior(drawn_scores(std::vector<double>(15, 1.0), random)) > 0.5 * kBatches;
  // The variance over candidates, which must stay under 4 / 60, has under the null a standard error of
  // sqrt(kurtosis of chi-square over its freedom, 4 or less) / 9.5 / sqrt(15) = 0.05: nine draws in ten do.
  EXPECT_GT(nearly_all, 0.8 * kDraws);
}

TEST(ScoreByBatches, AreHardlyBelievedWhiteWhereTheirScattersDiffer) {
  constexpr int kDraws = 400;
  Random random(13);
  int few = 0;
  for (int n = 0; n < kDraws; ++n)
    few += batches_of_prior(drawn_scores({1, 1, 1, 1, 1, 4, 4, 4, 4, 4, 1, 1, 4, 4, 1}, random)) < 0.2 * kBatches;
  // A variance of 4.5 over candidates, about one.
  EXPECT_GT(few, 0.99 * kDraws);
}

TEST(ScoreByBatches, WithoutAnyThatTellsAreBelievedLittle) {
  ScoreByBatches one;
  one.add(1.0, 1.0);
  one.finish();
  EXPECT_LT(batches_of_prior({one}), 0.2 * kBatches);
}

// As Eq. 5: with the same belief in all others, a score that scatters far beyond chance is inflated nearly as much.
TEST(ScoreByBatches, AreInflatedByWhatTheySayBeyondChance) {
  const double chi_square_95_of_11 = 19.675;  // any table
  EXPECT_NEAR(shrunk_inflation(14.0, 12.0, kBatches), 14.0 / (chi_square_95_of_11 / 11.0), 0.05);
  EXPECT_DOUBLE_EQ(shrunk_inflation(1.5, 12.0, 48.0), (48.0 + 12.0 * 1.5) / 60.0);
  EXPECT_DOUBLE_EQ(shrunk_inflation(0.3, 12.0, 48.0), 1.0);
}

// Fitted on either half and held against the other, what all batches share is kept, and what half of them contradict is
// lost.
TEST(ScoreByBatches, GainWhereTheHalvesAgree) {
  ScoreByBatches shared, contradicted;
  for (int n = 0; n < kOfBatches; ++n) shared.add(2.0, 1.0), contradicted.add(n % 2 == 0 ? 2.0 : -1.0, 1.0);
  shared.finish(), contradicted.finish();
  EXPECT_DOUBLE_EQ(shared.cross_validated(), kOfBatches * 2.0 * 2.0);
  EXPECT_LT(contradicted.cross_validated(), 0.0);
}

}  // namespace
}  // namespace odolab::test
