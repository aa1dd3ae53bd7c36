#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/effects/effect.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

Diagnosis scrubbing_by(double times_medium) {
  CaseSettings settings;
  settings.effect = times_medium > 0.0 ? "turn_scrub" : "";
  settings.size = times_medium;
  settings.runs = 3;
  settings.duration_s = 40.0;
  const Case c = generated_case(settings, 33);
  return diagnose(c.recordings, {}, c.nominal).value();
}

const AskedEffect& asked(const Diagnosis& d, const std::string& effect) {
  return *std::find_if(d.asked.begin(), d.asked.end(), [&](const AskedEffect& a) { return a.effect == effect; });
}

TEST(AskedEffects, HoldEveryEffectOnceThatEncodersCanShow) {
  const Diagnosis d = scrubbing_by(0.0);
  std::multiset<std::string> said, all;
  for (const AskedEffect& a : d.asked) {
    said.insert(a.effect);
    EXPECT_FALSE(a.named) << a.effect;
  }
  for (const Effect& e : catalogue())
    if (all.count(e.name) == 0 && !e.only_commands) all.insert(e.name);
  EXPECT_EQ(said, all);
}

// Scrub is a wheelbase that depends on the turn rate: what calibration takes of it goes into the wheelbase.
TEST(AskedEffects, SayWhatASizeThatWouldHaveBeenSeenIsAndWhatItBends) {
  const Diagnosis nothing = scrubbing_by(0.0);
  const AskedEffect& scrub = asked(nothing, "turn_scrub");
  ASSERT_TRUE(scrub.bends && scrub.least_seen && scrub.survives);
  EXPECT_EQ(scrub.bends->name, "wheelbase_m");
  EXPECT_EQ(scrub.least_seen->unit, "1/(rad/s)");
  EXPECT_LT(*scrub.survives, 1.0);
  // Half as much again is seen.
  const Diagnosis d = scrubbing_by(1.5 * scrub.least_seen->value / 0.01);
  EXPECT_TRUE(asked(d, "turn_scrub").named);
  EXPECT_LT(asked(d, "turn_scrub").p_value, 0.01);
  EXPECT_EQ(d.asked.front().effect, "turn_scrub");
}

}  // namespace
}  // namespace odolab::test
