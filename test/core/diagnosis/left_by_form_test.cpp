#include "core/diagnosis/naming/left_by_form.h"

#include <gtest/gtest.h>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/naming/select.h"

namespace odolab::test {
namespace {

constexpr double kError = 0.02;

ScoredCandidate name_of(const Effect& effect, double statistic, double p_value) {
  ScoredCandidate c;
  c.effect = &effect;
  c.test.statistic = statistic;
  c.p_value = p_value;
  return c;
}

TEST(LeftByForm, IsWhatHasLittleOfTheEvidenceAndLessThanSixStandardErrors) {
  const Effect strong, weak;
  EXPECT_TRUE(may_be_left_by_form({name_of(strong, 1600.0, 0.0), name_of(weak, 30.0, 2e-3)}, 1, kError));
  EXPECT_TRUE(may_be_left_by_form({name_of(strong, 1600.0, 0.0), name_of(weak, 40.0, 1e-6)}, 1, kError));
  EXPECT_FALSE(may_be_left_by_form({name_of(strong, 1600.0, 0.0), name_of(weak, 60.0, 1e-10)}, 1, kError))
      << "far beyond chance it is something by itself";
  EXPECT_FALSE(may_be_left_by_form({name_of(strong, 150.0, 0.0), name_of(weak, 30.0, 2e-3)}, 1, kError))
      << "of 150 no form leaves 30";
  EXPECT_FALSE(may_be_left_by_form({name_of(strong, 1600.0, 0.0), name_of(weak, 30.0, 2e-3)}, 0, kError))
      << "nor does the weak one leave the strong one";
  EXPECT_FALSE(may_be_left_by_form({name_of(weak, 30.0, 2e-3)}, 0, kError)) << "with no other name there is no form";
}

TEST(LeftByForm, AClockLeavesNoMoreHoweverFarItIsOff) {
  Effect clock;
  clock.clock_rate = true;
  const Effect weak;
  const double most = 0.15 * kDecisive;
  EXPECT_TRUE(may_be_left_by_form({name_of(clock, 1e6, 0.0), name_of(weak, 0.9 * most, 2e-3)}, 1, kError));
  EXPECT_FALSE(may_be_left_by_form({name_of(clock, 1e6, 0.0), name_of(weak, 1.1 * most, 2e-3)}, 1, kError));
}

}  // namespace
}  // namespace odolab::test
