#include "core/diagnosis/naming/compared_names.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

ScoredCandidate candidate(double statistic, double inflation, double log_tests) {
  ScoredCandidate c;
  c.effect = &catalogue().front();
  c.test.statistic = statistic;
  c.test.inflation = inflation;
  c.log_tests = log_tests;
  return c;
}

// A patch that is missing shows in all places that it overlaps, and so makes its own statistic look as wide as that.
TEST(ComparedNames, LeaveTheLikelierNameThoughItsEvidenceScattersMore) {
  const ScoredCandidate patch = candidate(17247.0, 103.0, 11.0), load = candidate(17018.0, 7.6, 8.4);
  EXPECT_FALSE(beats(load, patch));
  EXPECT_FALSE(beats(patch, load));  // nor is the patch believed by its own scatter
}

TEST(ComparedNames, AskOfWhatWasLookedForInMorePlacesThatItSaysSoMuchMore) {
  const ScoredCandidate own = candidate(40.0, 1.0, 4.0);
  EXPECT_TRUE(beats(candidate(51.0, 1.0, 4.0), own));
  EXPECT_FALSE(beats(candidate(51.0, 1.0, 10.0), own));  // e^6 times as many: 12 more
  EXPECT_TRUE(beats(candidate(63.0, 1.0, 10.0), own));
}

}  // namespace
}  // namespace odolab
