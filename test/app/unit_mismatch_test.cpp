#include "app/gui/unit_mismatch.h"

#include <gtest/gtest.h>

#include "core/diagnosis/diagnosis.h"
#include "test/support/miscounting_runs.h"

namespace odolab::test {
namespace {

// Truck B, which carries no truth, loses counts; truck A does not.
TEST(UnitMismatch, OfAHeldOutRunIsEachTrucksOwn) {
  const auto [nominal, fitted, left_out] = miscounting_runs(Clapper{}, linked_run, 0.10);
  const Result<Diagnosis> d = diagnose(fitted, {}, nominal);
  ASSERT_TRUE(d.ok());
  ASSERT_FALSE(d->findings.empty());
  const Diagnosis all = with_held_out_units(*d, fitted, {left_out}, nominal);
  for (const std::string& name : {fitted[0].name, left_out.name}) {
    const std::vector<UnitMismatch> units = unit_mismatches(all, name, nominal);
    ASSERT_EQ(units.size(), 2u) << name;
    EXPECT_EQ(units[0].unit, "truck_a");
    EXPECT_EQ(units[1].unit, "truck_b");
    for (const UnitMismatch& unit : units) {
      ASSERT_FALSE(unit.mismatch.after.empty()) << name << unit.unit;
      // Of noise alone the larger of two gathered sizes is a little above 1.
      EXPECT_LT(mean(unit.mismatch.after), 1.6) << name << unit.unit;
    }
    // A tenth of what a wheel rolls is far above its noise of a tenth of a per cent; it is in truck B's alone. (Of a
    // fitted run the noise before is as large as the effect made it.)
    const double factor = name == left_out.name ? 1.8 : 1.0;
    EXPECT_GT(mean(units[1].mismatch.before), factor * mean(units[1].mismatch.after)) << name;
    EXPECT_LT(mean(units[0].mismatch.before), 1.1 * mean(units[0].mismatch.after)) << name;
  }
}

}  // namespace
}  // namespace odolab::test
