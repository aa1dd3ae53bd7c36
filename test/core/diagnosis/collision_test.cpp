#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kPushed_s = 32.1;

// Four runs of a cart that something shoves aside by 8 cm in the third, under a camera that sees it three times a
// second.
std::vector<Recording> pushed_under_a_slow_camera(std::uint64_t seed) {
  Random random(seed);
  GeneratorSettings g;
  g.drive = {0.126, 0.126, 1.0876};
  g.wheel_noise = 0.0008;
  g.truth_period_s = 0.338;
  g.truth_has_heading = false;
  g.truth_position_noise_m = 0.014;
  g.duration_s = 60.0;
  std::vector<Recording> recordings;
  for (int run = 0; run < 4; ++run) {
    g.inject = [=](InjectedStep& s) {
      if (run != 2 || std::abs(s.time_s - kPushed_s) > 0.075) return;
      const double share = s.dt_s / 0.15;
      s.room_m = s.room_m + share * Vec2{-0.05, -0.064};
      s.turn_rad -= share * 0.026;
    };
    recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
    recordings.back().name = "run_" + std::to_string(run + 1);
  }
  return recordings;
}

// Of samples that contradict what was there before, the first are taken for glitches, and a push was said where these
// end: in one program's recordings half a second late, to a twentieth.
TEST(Collision, HappenedBeforeTheFirstSampleThatSawIt) {
  for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
    Vehicle nominal;
    nominal.kind = DifferentialDrive{0.127, 0.127, 1.05};
    const Diagnosis d = diagnose(pushed_under_a_slow_camera(seed), {}, nominal).value();
    ASSERT_FALSE(d.findings.empty()) << seed;
    const Finding& f = d.findings.front();
    ASSERT_EQ(f.effect, "collision") << seed;
    EXPECT_EQ(f.where.recording, "run_3");
    const FoundParameter& at = f.parameters.back();
    ASSERT_EQ(at.name, "at_s");
    EXPECT_NEAR(at.value, kPushed_s, 0.338) << seed;  // from one sample to the next
    EXPECT_LT(std::abs(at.value - kPushed_s), 4.0 * at.stderr_value) << seed;
  }
}

// What the truth of one run says between two times is moved, and then it is back: a marker was lost.
Case with_truth_elsewhere(std::uint64_t seed, double from_s, double to_s, double by_m, double by_rad) {
  CaseSettings settings;
  settings.duration_s = 40.0;
  settings.runs = 3;
  Case c = generated_case(settings, seed);
  for (Channel& channel : c.recordings[1].channels)
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (c.recordings[1].time_s[i] < from_s || c.recordings[1].time_s[i] > to_s) continue;
      if (channel.name == "truth_y_m") channel.values[i] += by_m;
      if (channel.name == "truth_heading_rad") channel.values[i] += by_rad;
    }
  return c;
}

TEST(Collision, IsNoneWhereTheTruthIsBackHalfASecondLater) {
  for (const std::uint64_t seed : {21u, 22u, 23u, 24u}) {
    const Case c = with_truth_elsewhere(seed, 20.0, 20.6, 0.01, 0.015);
    const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
    EXPECT_EQ(d.verdict, Verdict::nothing_missing) << seed;
    EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
      return w.find("run_1") != std::string::npos && w.find("the truth is elsewhere") != std::string::npos;
    })) << seed;
  }
}

TEST(Collision, StaysOneWhereTheTruthIsNotBackAgain) {
  for (const std::uint64_t seed : {21u, 22u, 23u, 24u}) {
    CaseSettings settings;
    settings.effect = "collision";
    settings.duration_s = 40.0;
    settings.runs = 3;
    const Case c = generated_case(settings, seed);
    const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
    ASSERT_FALSE(d.findings.empty()) << seed;
    EXPECT_EQ(d.findings.front().effect, "collision") << seed;
  }
}

// A tracker that sees a marker less for two seconds errs six times as much there, and a push is what such a scatter
// looks like first.
TEST(Collision, IsNotMadeOfATruthThatIsWorseForAWhile) {
  for (const std::uint64_t seed : {31u, 32u, 33u, 34u, 35u, 36u}) {
    Case c = with_truth_elsewhere(seed, 0.0, -1.0, 0.0, 0.0);
    Random random(seed);
    for (Channel& channel : c.recordings[1].channels)
      for (std::size_t i = 0; i < channel.values.size(); ++i) {
        if (std::abs(c.recordings[1].time_s[i] - 20.0) > 1.0) continue;
        if (channel.name == "truth_x_m" || channel.name == "truth_y_m") channel.values[i] += 0.006 * random.normal();
        if (channel.name == "truth_heading_rad") channel.values[i] += 0.012 * random.normal();
      }
    const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
    EXPECT_TRUE(std::none_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
      return f.effect == "collision" || f.effect == "bump";
    })) << seed;
  }
}

// Drives, rests from 30 to 38 s and drives on; in the middle of that rest it is put down elsewhere, by so much in the
// room. The camera may not see it meanwhile.
Recording lifted(Vec2 by, double turned_rad, bool is_seen) {
  Random random(31);
  GeneratorSettings g = under_motion_capture({0.1, 0.1, 0.45}, 0.0005, 0.1, 0.004, 0.006);
  g.duration_s = 90.0;
  const SpeedProfile drives = varied_driving(random, g.duration_s);
  bool is_done = false;
  g.inject = [&](InjectedStep& s) {
    if (s.time_s < 34.0 || std::exchange(is_done, true)) return;
    s.room_m = s.room_m + by;
    s.turn_rad += turned_rad;
  };
  const auto rests = [&](double t) {
    const double share = std::clamp(std::abs(t - 34.0) - 4.0, 0.0, 1.0);
    const WheelSpeedsAt w = drives(t);
    return WheelSpeedsAt{share * w.left_radps, share * w.right_radps};
  };
  Recording r = generated(g, rests, random);
  r.name = "lifted";
  for (Channel& c : r.channels)
    for (std::size_t i = 0; i < r.time_s.size(); ++i)
      if (!is_seen && c.name.rfind("truth", 0) == 0 && r.time_s[i] > 29.8 && r.time_s[i] < 38.2)
        c.values[i] = std::nan("");
  return r;
}

TEST(Collision, MovesTheVehicleAsFarInTheRoomHoweverFarItTurnsIt) {
  for (const double turned_rad : {-0.2, 1.2, 2.0})
    for (const bool is_seen : {true, false}) {
      const Vec2 by{0.8, -1.1};
      const Diagnosis d = diagnose({lifted(by, turned_rad, is_seen)}, {}, Vehicle{}).value();
      ASSERT_EQ(d.findings.front().effect, "collision") << turned_rad << is_seen;
      const auto found = [&](const char* name) {
        return *std::find_if(d.findings.front().parameters.begin(), d.findings.front().parameters.end(),
                             [&](const FoundParameter& p) { return p.name == name; });
      };
      // Samples are 4 mm and 6 mrad off.
      EXPECT_NEAR(found("dx_m").value, by.x_m, 0.03) << turned_rad << is_seen;
      EXPECT_NEAR(found("dy_m").value, by.y_m, 0.03) << turned_rad << is_seen;
      EXPECT_NEAR(found("dheading_rad").value, turned_rad, 0.02) << turned_rad << is_seen;
      EXPECT_LT(found("dx_m").stderr_value, 0.15);
    }
}

}  // namespace
}  // namespace odolab::test
