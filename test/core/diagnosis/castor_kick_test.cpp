#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kTrail_m = 0.04;  // between the trails that the forms have
constexpr double kCastorOff_rad = 5.0 * kPi / 180.0;

// Straights forth and back, in which it turns about within half a second, each long enough for a castor to swing round.
SpeedProfile straights(int run) {
  return [leg_s = 3.0 + run](double t) {
    const double pace = 4.0 * std::clamp(4.0 * std::sin(kPi * t / leg_s), -1.0, 1.0), turn = 0.2 * std::sin(0.3 * t);
    return WheelSpeedsAt{pace * (1.0 - turn), pace * (1.0 + turn)};
  };
}

// On them a castor that swings round: turned about, it stands five degrees off and obeys d(angle) = -sin(angle) / trail
// for each metre. The vehicle is turned by the share of half a turn that it swings.
std::vector<Recording> forth_and_back(Random& random, const DifferentialDrive& drive, double kick_rad,
                                      double scatter = 0.0) {
  GeneratorSettings g = under_motion_capture(drive, 0.0008, 0.01);
  g.duration_s = 60.0;
  const auto swinging = [kick_rad, scatter](int run) {
    return [kick_rad, scatter, each = Random(static_cast<std::uint64_t>(run)), this_rad = kick_rad, angle_rad = 0.0,
            direction = 1](InjectedStep& s) mutable {
      const double way_m = 0.5 * 0.075 * (s.left_radps + s.right_radps) * s.dt_s;
      const int now = way_m > 0.0 ? 1 : -1;
      if (now != direction) {
        angle_rad = kPi - kCastorOff_rad, direction = now;
        this_rad = kick_rad * (1.0 + scatter * each.normal());
      }
      const double swung = std::min(angle_rad, std::sin(angle_rad) * std::abs(way_m) / kTrail_m);
      angle_rad -= swung;
      s.turn_rad += this_rad * swung / kPi;
    };
  };
  return three_runs(g, random, straights, swinging);
}

void expect_kick_measured(const Diagnosis& d, double kick_rad) {
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "castor_reversal_kick");
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_LT(std::abs(p.value - kick_rad * (1.0 - kCastorOff_rad / kPi)), 3.0 * p.stderr_value)
      << p.value << " +- " << p.stderr_value;
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "collision");
}

TEST(CastorReversalKick, IsMeasuredAsTheCastorSwings) {
  constexpr double kKick_rad = 0.008;
  Random random(61);
  expect_kick_measured(diagnose(forth_and_back(random, {0.075, 0.075, 0.34}, kKick_rad), {}, Vehicle{}).value(),
                       kKick_rad);
}

TEST(CastorReversalKick, IsOneThoughNoTwoOfItsKicksAreAlike) {
  Random random(63);
  const Diagnosis d = diagnose(forth_and_back(random, {0.075, 0.075, 0.34}, 0.02, 0.6), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "castor_reversal_kick");
}

TEST(CastorReversalKick, IsMeasuredThoughItTurnsTheVehicleByLessThanACountOfItsWheels) {
  DifferentialDrive drive{0.075, 0.075, 0.34};
  drive.encoder_counts_per_revolution = 500.0;
  const double kick_rad = 0.8 * 2.0 * kPi * 0.075 / drive.counts_per_wheel_turn() / drive.wheelbase_m;
  Random random(62);
  Vehicle nominal;
  nominal.kind = drive;
  expect_kick_measured(diagnose(forth_and_back(random, drive, kick_rad), {}, nominal).value(), kick_rad);
}

// Where friction under the castors lets go bit by bit, each metre takes the same share of what is left of a kick.
TEST(CastorReversalKick, IsMeasuredWhereItFadesAsFrictionLetsGo) {
  constexpr double kKick_rad = 0.012;
  for (const double fades_m : {0.024, 0.09}) {  // between the lengths that the forms have
    Random random(64);
    GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.01);
    g.duration_s = 60.0;
    const auto fading = [fades_m](int) {
      return [fades_m, direction = 1, left = 0.0](InjectedStep& s) mutable {
        const double way_m = 0.5 * 0.075 * (s.left_radps + s.right_radps) * s.dt_s;
        const int now = way_m > 0.0 ? 1 : -1;
        if (now != direction) left = 1.0, direction = now;
        const double gone = left * -std::expm1(-std::abs(way_m) / fades_m);
        left -= gone;
        s.turn_rad += kKick_rad * gone;
      };
    };
    const Diagnosis d = diagnose(three_runs(g, random, straights, fading), {}, Vehicle{}).value();
    EXPECT_EQ(d.verdict, Verdict::found) << fades_m;
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings.front().effect, "castor_reversal_kick");
    EXPECT_NE(d.findings.front().form_in_words.find("fading"), std::string::npos) << d.findings.front().form_in_words;
    const FoundParameter& kick = d.findings.front().parameters.front();
    EXPECT_LT(std::abs(kick.value - kKick_rad), 3.0 * kick.stderr_value) << kick.value << " +- " << kick.stderr_value;
  }
}

// A castor whose fork has side play flops over as soon as it is pushed the other way: also where a stop swings back by
// two millimetres, which leads no castor round.
TEST(CastorReversalKick, IsMeasuredWhereStopsThatSwingBackKickTheHeadingToo) {
  constexpr double kKick_rad = 0.004, kLeg_s = 3.0, kStop_s = 0.8, kSlow_mps = 0.01, kLasts_s = 0.12;
  Random random(62);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.01);
  g.drive.encoder_counts_per_revolution = 16384.0;
  g.duration_s = 57.0;
  const auto legs = [](int run) -> SpeedProfile {
    return [run](double t) {
      const double in_leg = std::fmod(t, kLeg_s + kStop_s);
      const double direction = static_cast<int>(t / (kLeg_s + kStop_s) + run) / 2 % 2 == 0 ? 1.0 : -1.0;
      if (in_leg > kLeg_s) {
        const double swings = in_leg > kLeg_s + 0.2 && in_leg < kLeg_s + 0.3 ? -0.3 : 0.0;
        return WheelSpeedsAt{direction * swings, direction * swings};
      }
      const double pace = direction * 4.0 * std::sin(kPi * in_leg / kLeg_s), turn = 0.2 * std::sin(0.3 * t);
      return WheelSpeedsAt{pace * (1.0 - turn), pace * (1.0 + turn)};
    };
  };
  const auto flopping = [](int) {
    return [direction = 0, left_s = 0.0](InjectedStep& s) mutable {
      const double speed_mps = 0.5 * 0.075 * (s.left_radps + s.right_radps);
      const int now = speed_mps > kSlow_mps ? 1 : speed_mps < -kSlow_mps ? -1 : 0;
      if (now != 0 && now != direction) left_s = direction == 0 ? 0.0 : kLasts_s, direction = now;
      const double lasts_s = std::min(left_s, s.dt_s);
      s.turn_rad += kKick_rad * lasts_s / kLasts_s;
      left_s -= lasts_s;
    };
  };
  Vehicle nominal;
  nominal.kind = g.drive;
  const Diagnosis d = diagnose(three_runs(g, random, legs, flopping), {}, nominal).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.verdict, Verdict::found);
  EXPECT_EQ(d.findings.front().effect, "castor_reversal_kick");
  EXPECT_NE(d.findings.front().form_in_words.find("swings back"), std::string::npos)
      << d.findings.front().form_in_words;
  const FoundParameter& kick = d.findings.front().parameters.front();
  EXPECT_NEAR(kick.value, kKick_rad, 4.0 * kick.stderr_value);
}

}  // namespace
}  // namespace odolab::test
