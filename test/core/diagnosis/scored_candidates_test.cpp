#include "core/diagnosis/naming/scored_candidates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/calibrated_model.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Of noise, a number that may only be positive comes out so one time in two; one of either sign always.
TEST(ScoredCandidate, OfOneSignIsLookedForHalfAsOften) {
  CaseSettings settings;
  settings.effect = "turn_speed_loss";
  settings.runs = 2;
  settings.duration_s = 30.0;
  const Case c = generated_case(settings, 12);
  const JointModel joint = calibrated_model(c.recordings, c.nominal);
  const CandidateScan scan(joint, JointModel::kNone);
  int seen = 0;
  for (const Effect& e : catalogue()) {
    if (e.name != "turn_speed_loss" && e.name != "one_sided_drag") continue;
    const double sides = e.name == "one_sided_drag" ? 2.0 : 1.0;
    EXPECT_DOUBLE_EQ(scored_candidate(joint, scan, e, {.tests = 10}).log_tests, std::log(10.0 * sides / 2.0))
        << e.name;
    ++seen;
  }
  EXPECT_EQ(seen, 2);
}

}  // namespace
}  // namespace odolab::test
