// Names that runs which were not fitted deny, or bear out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// It moves no error over a metre by much: each sample denies a little.
TEST(Refuted, NameIsWithdrawnWhereThousandsOfSamplesThatWereNotFittedDenyItTogether) {
  test::GeneratorSettings g = test::under_motion_capture({}, 0.0003, 0.02);
  g.duration_s = 60.0;
  Random random(31);
  const auto driving = [&](int) { return test::varied_driving(random, g.duration_s); };
  const auto oval = [](int) { return [](test::InjectedStep& s) { s.left_m *= 1.0 + 0.01 * std::sin(s.left_rad); }; };
  const auto round = [](int) { return [](test::InjectedStep&) {}; };
  const std::vector<Recording> given = test::three_runs(g, random, driving, oval);
  std::vector<Recording> unseen = test::three_runs(g, random, driving, round);
  for (Recording& r : unseen) r.name = "unseen_" + r.name;
  const Result<Diagnosis> named = diagnose(given, {}, Vehicle{});
  ASSERT_TRUE(named);
  ASSERT_EQ(named->findings.front().effect, "wheel_eccentricity");
  const Result<Diagnosis> denied = diagnose(given, unseen, Vehicle{});
  ASSERT_TRUE(denied);
  for (const Finding& f : denied->findings) EXPECT_NE(f.effect, "wheel_eccentricity");
  EXPECT_TRUE(std::any_of(denied->warnings.begin(), denied->warnings.end(), [](const std::string& w) {
    return w.find("what was not fitted is predicted worse with it") != std::string::npos;
  }));
}

TEST(Refuted, NameIsWithdrawnAndSaidWhereARunThatWasNotFittedContradictsIt) {
  test::Case slippery = test::case_of("slip_zone", 3.0, 4, 7), sound = test::case_of("", 1.0, 4, 7);
  const std::vector<Recording> fitted(slippery.recordings.begin(), slippery.recordings.begin() + 3);
  const Result<Diagnosis> borne_out = diagnose(fitted, {slippery.recordings[3]}, slippery.nominal);
  ASSERT_TRUE(borne_out);
  ASSERT_EQ(borne_out->findings.front().effect, "slip_zone");
  const Result<Diagnosis> d = diagnose(fitted, {sound.recordings[3]}, slippery.nominal);
  ASSERT_TRUE(d);
  for (const Finding& f : d->findings) EXPECT_NE(f.effect, "slip_zone");
  EXPECT_TRUE(std::any_of(d->warnings.begin(), d->warnings.end(), [](const std::string& w) {
    return w.find("slip zone") != std::string::npos && w.find("not fitted") != std::string::npos;
  }));
}

TEST(Refuted, WeakNameIsWithdrawnWhereItIsNoMoreThanChanceInAllRecordingsTogether) {
  // Two runs in which the robot scrubs, 5 standard errors in all, and four of the same robot in which it does or does
  // not.
  test::Case scrubs = test::case_of("turn_scrub", 1.1, 6, 7), sound = test::case_of("", 1.0, 6, 7);
  const auto behind_two = [](const test::Case& c) {
    return std::vector<Recording>(c.recordings.begin() + 2, c.recordings.end());
  };
  const std::vector<Recording> fitted(scrubs.recordings.begin(), scrubs.recordings.begin() + 2);
  const Result<Diagnosis> borne_out = diagnose(fitted, behind_two(scrubs), scrubs.nominal);
  ASSERT_TRUE(borne_out);
  ASSERT_FALSE(borne_out->findings.empty());
  EXPECT_EQ(borne_out->findings.front().effect, "turn_scrub");
  const Result<Diagnosis> d = diagnose(fitted, behind_two(sound), scrubs.nominal);
  ASSERT_TRUE(d);
  for (const Finding& f : d->findings) EXPECT_NE(f.effect, "turn_scrub");
  EXPECT_TRUE(std::any_of(d->warnings.begin(), d->warnings.end(), [](const std::string& w) {
    return w.find("turn scrub") != std::string::npos && w.find("no more than chance") != std::string::npos;
  }));
}

TEST(Named, IsWhatTheRecordingsOnlyHintAtWhereThoseHeldOutBearItOut) {
  // The same with less of it: too little in two runs by themselves.
  test::Case scrubs = test::case_of("turn_scrub", 0.75, 6, 7), sound = test::case_of("", 1.0, 6, 7);
  const auto behind_two = [](const test::Case& c) {
    return std::vector<Recording>(c.recordings.begin() + 2, c.recordings.end());
  };
  const std::vector<Recording> fitted(scrubs.recordings.begin(), scrubs.recordings.begin() + 2);
  const Diagnosis alone = diagnose(fitted, {}, scrubs.nominal).value();
  for (const Finding& f : alone.findings) EXPECT_NE(f.effect, "turn_scrub");
  const Diagnosis borne_out = diagnose(fitted, behind_two(scrubs), scrubs.nominal).value();
  ASSERT_FALSE(borne_out.findings.empty());
  EXPECT_EQ(borne_out.findings.front().effect, "turn_scrub");
  EXPECT_LT(borne_out.findings.front().p_value, 0.02);  // of all recordings together
  EXPECT_TRUE(std::any_of(borne_out.warnings.begin(), borne_out.warnings.end(),
                          [](const std::string& w) { return w.find("hint at turn scrub") != std::string::npos; }));
  const Diagnosis not_borne_out = diagnose(fitted, behind_two(sound), scrubs.nominal).value();
  for (const Finding& f : not_borne_out.findings) EXPECT_NE(f.effect, "turn_scrub");
}

TEST(Refuted, AsksOfARunThatWasNotFittedWhetherTheLoadThatCameAndStayedIsThereToo) {
  test::Case c = test::case_of("", 1.0, 4, 8);
  for (std::size_t r = 1; r < c.recordings.size(); ++r)
    for (Channel& channel : c.recordings[r].channels)
      if (channel.name == "left_wheel_rad" || channel.name == "right_wheel_rad")
        for (double& v : channel.values) v /= 0.96;  // radii 4 % less
  const Result<Diagnosis> d = diagnose({c.recordings.begin(), c.recordings.begin() + 3}, {c.recordings[3]}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->findings.front().effect, "payload_radius_change");
  // Without it the radii are off by more than 1 %, 10 mm over a metre beside 6 mm of noise.
  EXPECT_LT(d->held_out.with_findings->position_rms_m, 0.7 * d->held_out.calibrated->position_rms_m);
}

}  // namespace
}  // namespace odolab
