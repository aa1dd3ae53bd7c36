// What joints read, by all units together beside a fine outside truth.
#include "core/diagnosis/units/joints_by_all.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/crooked_vehicles.h"

namespace odolab::test {
namespace {

constexpr double kSmall_rad = 0.0015;

MultiCastor finely_read(MultiCastor platform) {
  platform.pivot_encoder_resolution_rad = 0.0005;
  return platform;
}

std::vector<Recording> platform_runs(const MultiCastor& actual, std::uint64_t seed) {
  LinkedRunSettings settings;
  settings.duration_s = 60.0;
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(actual, settings, seed + k));
  return runs;
}

const Finding* finding_of_effect(const Diagnosis& d, const std::string& effect) {
  const auto f =
      std::find_if(d.findings.begin(), d.findings.end(), [&](const Finding& g) { return g.effect == effect; });
  return f == d.findings.end() ? nullptr : &*f;
}

// Over stretches of half a metre beside the truth it is known to some tenths of a milliradian.
TEST(JointsByAll, KnowAPivotThatIsOffByATwelfthOfADegree) {
  MultiCastor actual = finely_read(crooked_castors());
  actual.castors[1].pivot_encoder_offset_rad = kSmall_rad;
  const Result<Diagnosis> d = diagnose(platform_runs(actual, 401), {}, vehicle_of(finely_read(three_castor_vehicle())));
  ASSERT_TRUE(d);
  const Finding* bias = finding_of_effect(*d, "pivot_angle_bias");
  ASSERT_TRUE(bias);
  EXPECT_EQ(bias->component, "castor2");
  const FoundParameter& p = bias->parameters[0];
  EXPECT_NEAR(p.value, kSmall_rad, 3.0 * p.stderr_value);
  EXPECT_LT(p.stderr_value, 0.1 * kSmall_rad);
}

// In its mean over the angles that it takes it errs, too.
TEST(JointsByAll, TakeAPivotsEncoderThatWobblesForNoBias) {
  const MultiCastor file = finely_read(three_castor_vehicle());
  std::vector<Recording> runs = platform_runs(finely_read(crooked_castors()), 411);
  for (Recording& r : runs)
    for (Channel& c : r.channels)
      if (c.name == "castor2_pivot_rad")
        for (double& reading : c.values) reading += 2.0 * kSmall_rad * std::sin(reading + 2.5);
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(file));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  ASSERT_FALSE(d->findings.empty());
  EXPECT_EQ(d->findings[0].component, "castor2");
  EXPECT_FALSE(finding_of_effect(*d, "pivot_angle_bias"));
  ASSERT_FALSE(d->findings[0].alternatives.empty());
  EXPECT_EQ(d->findings[0].alternatives[0].effect, "pivot_angle_bias");
}

// Of a link's two angles wide bends tell the difference alone.
TEST(JointsByAll, SayOfALinkWhichEndsItMayBe) {
  Clapper actual = fine_clapper();
  actual.link_angle_a_offset_rad = 2.0 * kSmall_rad;
  const Result<Diagnosis> d = diagnose(clapper_runs(actual, {}, 421), {}, vehicle_of(fine_clapper()));
  ASSERT_TRUE(d);
  const Finding* bias = finding_of_effect(*d, "link_angle_bias");
  ASSERT_TRUE(bias);
  std::vector<std::string> ends = {bias->component};
  for (const Alternative& a : bias->alternatives)
    if (a.effect == "link_angle_bias") ends.push_back(a.component);
  EXPECT_TRUE(std::find(ends.begin(), ends.end(), "truck_a") != ends.end());
  EXPECT_NEAR(std::abs(bias->parameters[0].value), 2.0 * kSmall_rad, 3.0 * bias->parameters[0].stderr_value);
}

}  // namespace
}  // namespace odolab::test
