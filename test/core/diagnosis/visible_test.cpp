#include "core/diagnosis/advice/visible.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace odolab {
namespace {

// What would have had to be so many times the medium size to be seen.
Visible seen_from(const char* effect, double needed) {
  Visible v;
  v.effect = &*std::find_if(catalogue().begin(), catalogue().end(), [&](const Effect& e) { return e.name == effect; });
  v.needed = needed;
  v.survives = 0.5;
  v.excited = true;
  return v;
}

// A medium drag turns by 0.01 rad per metre, and none by more than 1.
TEST(Visible, NothingOfAnEffectCouldShowWhereOnlyMoreThanItCanBeWouldHave) {
  const Visible beyond = seen_from("one_sided_drag", 190.0), within = seen_from("one_sided_drag", 50.0);
  EXPECT_EQ(because_of(beyond), "none of any size that it can have would have shown here");
  EXPECT_FALSE(least_seen(beyond));
  EXPECT_EQ(because_of(within),
            "less than 29\xC2\xB0/m would not have shown here, and 0.57\xC2\xB0/m is of importance");
  EXPECT_NEAR(least_seen(within).value().value, 0.5, 1e-9);
}

// A medium push is one of 20 mm.
TEST(Visible, SizesOfHundredsAreSaidWithoutAnExponent) {
  EXPECT_EQ(because_of(seen_from("collision", 21.0)),
            "less than 420 mm would not have shown here, and 20 mm is of importance");
  EXPECT_EQ(because_of(seen_from("collision", 4.99)),
            "less than 100 mm would not have shown here, and 20 mm is of importance");
}

}  // namespace
}  // namespace odolab
