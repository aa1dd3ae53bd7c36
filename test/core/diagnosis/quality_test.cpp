#include "core/diagnosis/quality/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/quality/standing_encoder.h"
#include "test/support/drive_generator.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// Drives for 10 s, stands for 10 s, drives on.
Recording with_a_rest(double truth_late_s = 0.0) {
  test::GeneratorSettings g;
  g.truth.time_offset_s = truth_late_s;
  g.duration_s = 30.0;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.001;
  Random random(3);
  return generated(
      g,
      [](double t) {
        const double pace = t < 10.0 || t > 20.0 ? 4.0 : 0.0;
        return test::WheelSpeedsAt{pace, 1.1 * pace};
      },
      random);
}

void freeze(Recording& r, double from_s, double to_s) {
  for (Channel& c : r.channels) {
    if (c.name.rfind("truth_", 0) != 0) continue;
    double last = 0.0;
    for (std::size_t i = 0; i < r.time_s.size(); ++i) {
      if (!std::isfinite(c.values[i])) continue;
      if (r.time_s[i] > from_s && r.time_s[i] < to_s) c.values[i] = last;
      last = c.values[i];
    }
  }
}

TEST(Checked, LeavesATruthThatRepeatsItselfAtRestAlone) {
  Recording r = with_a_rest();
  freeze(r, 14.0, 14.6);
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesARestForARestWhereTheTruthIsMissingAtItsEnd) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    if (c.name.rfind("truth_", 0) == 0)
      for (std::size_t i = 0; i < r.time_s.size(); ++i)
        if (r.time_s[i] > 19.0 && r.time_s[i] < 22.0) c.values[i] = std::nan("");  // by 22 s it is 0.6 m further on
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesARestForARestWhereTheTruthErrsOnceAtItsEnd) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    if (c.name == "truth_x_m")
      for (std::size_t i = 0; i < r.time_s.size(); ++i)
        if (std::abs(r.time_s[i] - 20.0) < 0.03) c.values[i] += 0.8;  // one sample
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesARestForARestWhereTheTruthsClockIsLate) {
  Recording r = with_a_rest(0.4);
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, LeavesItOutAtRestTooWhereItDoesSoOnTheWay) {
  Recording r = with_a_rest();
  freeze(r, 5.0, 5.6);
  freeze(r, 14.0, 14.6);
  const CheckedRecording c = checked(r, Vehicle{});
  ASSERT_EQ(c.faults.size(), 1u);
  ASSERT_EQ(c.faults[0].time_s.size(), 2u);
  EXPECT_NEAR(c.faults[0].time_s[1].first, 14.0, 0.06);  // the truth comes every 0.05 s
  EXPECT_NEAR(c.faults[0].time_s[1].second, 14.6, 0.06);
}

// Half a second in which the left wheel rolls 6 cm and its encoder says nothing, then or later.
Recording with_counts_lost(double truth_position_noise_m, double truth_heading_noise_rad) {
  test::GeneratorSettings g;
  g.drive.wheel_radius_left_m = g.drive.wheel_radius_right_m = 0.03;
  g.drive.wheelbase_m = 0.15;
  g.truth_position_noise_m = truth_position_noise_m;
  g.truth_heading_noise_rad = truth_heading_noise_rad;
  g.inject = [](test::InjectedStep& s) {
    if (s.time_s > 12.0 && s.time_s < 12.5) s.left_read_rad = 0.0;
  };
  Random random(3);
  return generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{4.0 + std::sin(t), 4.0 + std::cos(0.7 * t)};
      },
      random);
}

Vehicle small_robot() {
  Vehicle v;
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.0303;  // a file that is a little wrong
  drive.wheelbase_m = 0.156;
  v.kind = drive;
  return v;
}

TEST(Checked, FindsAnEncoderThatStandsByTheTurnWherePlacesAreCoarse) {
  for (const double noise_m : {0.001, 0.02}) {
    const CheckedRecording c = checked(with_counts_lost(noise_m, 0.005), small_robot());
    ASSERT_EQ(c.faults.size(), 1u) << noise_m;
    EXPECT_EQ(c.faults[0].component, "left_wheel");
    ASSERT_EQ(c.faults[0].time_s.size(), 1u);
    EXPECT_NEAR(c.faults[0].time_s[0].first, 12.0, 0.05);
    EXPECT_NEAR(c.faults[0].time_s[0].second, 12.5, 0.05);
  }
}

// About one wheel that stands, by twice around: a wheelbase that is 4 % wrong makes 8 cm of it.
TEST(Checked, TakesAWheelThatIsPivotedAboutForOneThatStands) {
  test::GeneratorSettings g;
  g.drive.wheel_radius_left_m = g.drive.wheel_radius_right_m = 0.03;
  g.drive.wheelbase_m = 0.15;
  g.truth_heading_noise_rad = 0.002;
  for (const double noise_m : {0.0005, 0.02}) {
    g.truth_position_noise_m = noise_m;
    Random random(5);
    const Recording r = generated(
        g,
        [](double t) {
          return test::WheelSpeedsAt{t > 10.0 && t < 20.0 ? 0.0 : 4.0, 6.0};
        },
        random);
    EXPECT_TRUE(checked(r, small_robot()).faults.empty()) << noise_m;
  }
}

TEST(Checked, TakesAnEncoderOfTwelveCountsForSoundWhereOneOfThemLasts) {
  Recording r;
  test::GeneratorSettings g;
  g.drive.encoder_counts_per_revolution = 12.0;
  g.drive.gear_ratio = 1.0;
  g.duration_s = 40.0;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.002;
  Random random(4);
  r = generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{3.0 + 2.8 * std::sin(0.5 * t), 3.0 - 2.8 * std::sin(0.5 * t)};
      },
      random);
  Vehicle vehicle;
  vehicle.kind = g.drive;
  EXPECT_TRUE(checked(r, vehicle).faults.empty());
}

// Brakes to rest at 9 s and stands to the end at 10 s, while the truth's clock runs half a second late.
TEST(Checked, TakesAWheelThatIsBrakedForSoundWhereALateTruthRunsOn) {
  test::GeneratorSettings g;
  g.duration_s = 10.0;
  g.truth.time_offset_s = 0.5;
  g.truth_position_noise_m = g.truth_heading_noise_rad = 0.001;
  Random random(5);
  const Recording r = generated(
      g,
      [](double t) {
        const double pace = 6.0 * std::clamp(9.0 - t, 0.0, 1.0);
        return test::WheelSpeedsAt{pace, pace};
      },
      random);
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesAWheelThatSetsOffLateForSound) {
  test::GeneratorSettings g;
  g.duration_s = 10.0;
  Random random(6);
  const Recording r = generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{3.0, t < 1.4 ? 0.0 : t < 1.42 ? 3.0 : 0.3};  // jerks, and then creeps
      },
      random);
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

// Both wheels speed up from rest, 25 readings a second; the left counter holds from 0.24 s on, for 0.8 s,
// and then has all of it at once.
TEST(CatchingUpEncoder, IsOneThatHoldsWhileItsWheelSpeedsUp) {
  constexpr double kPeriod_s = 0.04, kCount_rad = 0.001, kSpeedsUp_radps2 = 4.0;
  const auto read_rad = [](double t) { return std::floor(0.5 * kSpeedsUp_radps2 * t * t / kCount_rad) * kCount_rad; };
  std::vector<WheelSample> wheels;
  for (int i = 0; i < 60; ++i) {
    const double t = kPeriod_s * i, left_at = t > 0.24 && t < 1.04 ? 0.24 : t;
    wheels.push_back({t, read_rad(left_at), read_rad(t)});
  }
  const TimeStretches found = catching_up_encoder(wheels, Wheel::left);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].first, 0.24, kPeriod_s);
  EXPECT_NEAR(found[0].second, 1.04, kPeriod_s);
  EXPECT_TRUE(catching_up_encoder(wheels, Wheel::right).empty());
}

// It crawled backward, stood and set off forward, while the other set off five times as fast.
TEST(CatchingUpEncoder, IsNoneThatTurnsBackAfterItStood) {
  std::vector<WheelSample> wheels;
  const double turned_rad[] = {0.0,     -0.0069, -0.0107, -0.0130, -0.0138, -0.0146, -0.0153, -0.0153, -0.0153,
                               -0.0153, -0.0153, -0.0038, 0.0322,  0.0591,  0.0491,  0.0284,  0.0108,  -0.0007};
  for (const double rad : turned_rad)
    wheels.push_back({0.05 * static_cast<double>(wheels.size()), std::max(0.0, 5.0 * rad), rad});
  EXPECT_TRUE(catching_up_encoder(wheels, Wheel::right).empty());
}

// A counter that steps back for good, under a truth of 100 Hz that is late by five readings: it is left out at its own
// time, once, and nothing is left of it behind.
TEST(Diagnosis, LeavesACounterThatStepsBackOutWhereTheTruthIsLateToo) {
  test::CaseSettings settings;
  settings.runs = 3;
  settings.duration_s = 40.0;
  settings.truth_late_s = 0.06;
  test::Case c = test::generated_case(settings, 31);
  constexpr double kAt_s = 18.0, kBack_rad = 0.35;
  Recording& r = c.recordings.front();
  for (Channel& channel : r.channels)
    for (std::size_t i = 0; channel.name == "right_wheel_rad" && i < r.time_s.size(); ++i)
      if (r.time_s[i] > kAt_s) channel.values[i] -= kBack_rad;
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::found);
  int faults = 0;
  for (const Finding& f : d->findings) {
    EXPECT_TRUE(f.effect == "encoder_data_fault" || f.effect.rfind("truth_", 0) == 0) << f.effect;
    if (f.effect != "encoder_data_fault") continue;
    ++faults;
    ASSERT_EQ(f.where.time_s.size(), 1U);
    EXPECT_NEAR(f.where.time_s.front().first, kAt_s, 0.03);  // a reading and a half
  }
  EXPECT_EQ(faults, 1);
  // As noise alone leaves it: the error was twice that where the sample behind the step was kept.
  ASSERT_TRUE(d->train.calibrated);
  EXPECT_LT(d->train.calibrated->position_rms_m, 1.2 * d->train.noise_floor->position_rms_m);
}

// It gives no finding, since it gives no name either.
TEST(Diagnosis, SaysWhatIsWrongWithARecordingThatIsHeldOut) {
  test::CaseSettings settings;
  settings.runs = 3;
  settings.duration_s = 30.0;
  test::Case c = test::generated_case(settings, 33);
  Recording held_out = std::move(c.recordings.back());
  c.recordings.pop_back();
  held_out.name = "held.csv";
  for (Channel& channel : held_out.channels)
    for (std::size_t i = 0; channel.name == "left_wheel_rad" && i < held_out.time_s.size(); ++i)
      if (held_out.time_s[i] > 12.0) channel.values[i] -= 7.0;
  const Result<Diagnosis> d = diagnose(c.recordings, {held_out}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_TRUE(std::any_of(d->warnings.begin(), d->warnings.end(), [](const std::string& w) {
    return w.rfind("held.csv from 12.0", 0) == 0 && w.find("encoder") != std::string::npos;
  }));
}

// The file has the marker where it is, 0.3 m beside the axle: it swings around a wheel that is pivoted about.
TEST(Checked, TakesAWheelForSoundThatIsPivotedAboutUnderAMarkerThatSitsAside) {
  for (const bool is_known : {true, false}) {
    test::GeneratorSettings g;
    g.drive.wheel_radius_left_m = g.drive.wheel_radius_right_m = 0.03;
    g.drive.wheelbase_m = 0.15;
    g.truth.axle_T_tracked = {0.0, is_known ? 0.3 : 0.03, 0.0};
    g.truth_position_noise_m = 0.001;
    g.truth_heading_noise_rad = 0.02;
    Random random(6);
    const Recording r = generated(
        g,
        [](double t) {
          return test::WheelSpeedsAt{t > 10.0 && t < 14.0 ? 0.0 : 4.0, 6.0};
        },
        random);
    Vehicle vehicle = small_robot();
    if (is_known) vehicle.truth.axle_T_tracked = g.truth.axle_T_tracked;
    EXPECT_TRUE(checked(r, vehicle).faults.empty()) << is_known;
  }
}

TEST(Checked, TakesOneHeadingThroughoutForNoneWhereTheWheelsTurn) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    if (c.name == "truth_heading_rad")
      for (double& v : c.values)
        if (!std::isnan(v)) v = 0.0;
  const CheckedRecording c = checked(r, Vehicle{});
  EXPECT_FALSE(c.recording.channel("truth_heading_rad"));
  ASSERT_FALSE(c.warnings.empty());
  EXPECT_NE(c.warnings.front().find("truth_heading_rad is 0 throughout"), std::string::npos) << c.warnings.front();
  EXPECT_TRUE(checked(with_a_rest(), Vehicle{}).recording.channel("truth_heading_rad"));
}

TEST(Checked, SaysForHowLongNobodyLooked) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    for (std::size_t i = 0; i < r.time_s.size(); ++i)
      if (c.name.rfind("truth_", 0) == 0 && (std::abs(r.time_s[i] - 5.0) < 3.0 || std::abs(r.time_s[i] - 15.0) < 3.5))
        c.values[i] = std::nan("");
  const CheckedRecording c = checked(r, Vehicle{});
  ASSERT_EQ(c.warnings.size(), 1u);  // it rests from 10 to 20 s
  EXPECT_NE(c.warnings[0].find("no truth from 2.0 to 8.0 s, while the wheels turn"), std::string::npos)
      << c.warnings[0];
  EXPECT_TRUE(checked(with_a_rest(), Vehicle{}).warnings.empty());
}

// Both encoders hold while the truth goes on by 1.5 m: that is no encoder's doing.
TEST(Checked, SaysThatBothEncodersStandAtOnce) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    if (c.name.find("wheel") != std::string::npos) {
      double held = 0.0, lost = 0.0;
      for (std::size_t i = 0; i < r.time_s.size(); ++i) {
        if (std::isnan(c.values[i])) continue;
        if (r.time_s[i] < 4.0) held = c.values[i];
        if (r.time_s[i] < 8.0) lost = c.values[i] - held;
        c.values[i] = r.time_s[i] < 4.0 ? c.values[i] : r.time_s[i] < 8.0 ? held : c.values[i] - lost;
      }
    }
  const CheckedRecording c = checked(r, Vehicle{});
  ASSERT_EQ(c.faults.size(), 2u);
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_NE(c.warnings[0].find("both encoders err at once"), std::string::npos) << c.warnings[0];
}

}  // namespace
}  // namespace odolab
