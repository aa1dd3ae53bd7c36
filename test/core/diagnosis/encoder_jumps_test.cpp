#include "core/diagnosis/quality/encoder_jumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/diagnosis/quality/quality.h"
#include "core/geometry/track.h"
#include "core/odometry/differential_drive.h"

namespace odolab {
namespace {

constexpr double kJumpingRadius_m = 0.125, kCounts = 2048.0, kCount_rad = 2.0 * M_PI / kCounts, kReading_s = 0.01;

struct Read {
  std::vector<double> time_s, angle_rad;
};

// A wheel at speeds of its own, read in whole counts 100 times a second for four seconds.
Read read(double (*speed_radps)(double)) {
  Read out;
  double angle_rad = 0.0;
  for (int i = 0; i < 400; ++i) {
    out.time_s.push_back(kReading_s * i);
    out.angle_rad.push_back(kCount_rad * std::floor(angle_rad / kCount_rad));
    angle_rad += kReading_s * speed_radps(out.time_s.back());
  }
  return out;
}

TimeStretches jumps_of(const Read& r) { return encoder_jumps(r.time_s, r.angle_rad, kJumpingRadius_m, kCount_rad); }

double drives(double time_s) { return 6.0 + 3.0 * std::sin(2.0 * time_s); }

TEST(EncoderJumps, AreFoundWhereCountsAreLostForGoodWithinOneReading) {
  for (double lost_rad : {0.05, 0.12, -0.08}) {
    Read r = read(drives);
    for (std::size_t i = 201; i < r.angle_rad.size(); ++i) r.angle_rad[i] -= lost_rad;
    const TimeStretches jumps = jumps_of(r);
    ASSERT_EQ(jumps.size(), 1u) << lost_rad;
    EXPECT_DOUBLE_EQ(jumps.front().first, r.time_s[200]);
    EXPECT_DOUBLE_EQ(jumps.front().second, r.time_s[201]);
  }
}

TEST(EncoderJumps, AreNotWhereAWheelOnlySetsOffStopsReversesOrRunsEvenly) {
  EXPECT_TRUE(jumps_of(read(drives)).empty());
  EXPECT_TRUE(jumps_of(read([](double t) { return t < 1.0 ? 0.0 : t < 2.0 ? 6.0 : 0.0; })).empty());
  EXPECT_TRUE(jumps_of(read([](double t) { return t < 2.0 ? 6.0 : -6.0; })).empty());
}

// Counts that are read evenly and stamped when they arrive: two that arrive together look like a leap.
TEST(EncoderJumps, AreNotWhereOnlyAStampIsLate) {
  for (double reading_s : {0.005, 0.1}) {
    Read r;
    for (int i = 0; i < 400; ++i) {
      r.time_s.push_back(reading_s * i);
      r.angle_rad.push_back(kCount_rad * std::floor(6.0 * r.time_s.back() / kCount_rad));
    }
    Read late = r;
    late.time_s[200] += 0.8 * reading_s;
    EXPECT_TRUE(jumps_of(late).empty()) << reading_s;
    for (std::size_t i = 201; i < late.angle_rad.size(); ++i) late.angle_rad[i] -= 3.0 * 6.0 * reading_s;
    EXPECT_EQ(jumps_of(late).size(), 1u) << "and what is lost besides shows as it did";
  }
}

TEST(EncoderJumps, AreFoundWhereOneReadingInTenIsWrittenTwice) {
  Recording r;
  const Read read_once = read(drives);
  std::vector<double> left, right;
  for (std::size_t i = 0; i < read_once.time_s.size(); ++i)
    for (int times = i % 10 == 5 ? 2 : 1; times > 0; --times) {
      r.time_s.push_back(read_once.time_s[i]);
      left.push_back(read_once.angle_rad[i] - (i > 200 ? 0.12 : 0.0));
      right.push_back(read_once.angle_rad[i]);
    }
  r.channels = {{"left_wheel_rad", left}, {"right_wheel_rad", right}};
  Vehicle vehicle;
  vehicle.kind = DifferentialDrive{kJumpingRadius_m, kJumpingRadius_m, 0.4};
  const std::vector<DataFault> faults = checked(r, vehicle).faults;
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults.front().component, "left_wheel");
  ASSERT_EQ(faults.front().time_s.size(), 1u);
  EXPECT_NEAR(faults.front().time_s.front().first, 2.0, 1e-9);
}

TEST(EncoderJumps, AreNotWhereReadingsAreCoarse) {
  Read r = read([](double) { return 1.0; });
  for (double& a : r.angle_rad) a = 0.1 * std::floor(a / 0.1);
  EXPECT_TRUE(encoder_jumps(r.time_s, r.angle_rad, kJumpingRadius_m, 0.1).empty());
}

// Straight on at 0.3 m/s, read 25 times a second, for twelve seconds; the left wheel's reading falls behind by 0.1 rad
// between two readings, which a tyre could do, and stays so. The truth is of a millimetre; `followed`: it did so, too.
InnovationRun falls_behind(const InnovationModel& model, bool followed) {
  constexpr double kSpeed_radps = 3.0, kLost_rad = 0.1, kAt_s = 6.01;
  Random random(3);
  InnovationRun run;
  Track way;
  Pose pose;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.04 * i, angle = kSpeed_radps * t, lost = t > kAt_s ? kLost_rad : 0.0;
    run.wheels.push_back({t, angle - lost, angle});
    const bool now = followed && t > kAt_s && t - 0.04 <= kAt_s;
    if (i > 0)
      pose = dead_reckoned(pose, 0.04 * kSpeed_radps - (now ? kLost_rad : 0.0), 0.04 * kSpeed_radps, model.drive);
    way.push_back({t, pose});
  }
  for (int k = 0; k <= 1200; ++k) {
    const Pose at = *pose_at(way, 0.01 * k);
    run.truth.push_back({0.01 * k,
                         {at.x_m + 0.001 * random.normal(), at.y_m + 0.001 * random.normal()},
                         at.heading_rad + 0.002 * random.normal()});
  }
  run.truth_has_heading = true;
  run.set_aside.assign(run.truth.size(), 0);
  return run;
}

TEST(EncoderJumps, AreWhereAReadingIsOffItsPaceAndTheTruthIsNot) {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  const InnovationRun jumps = falls_behind(model, false), slows = falls_behind(model, true);
  std::vector<double> time_s, angle_rad;
  for (const WheelSample& w : jumps.wheels) time_s.push_back(w.time_s), angle_rad.push_back(w.left_rad);
  EXPECT_TRUE(encoder_jumps(time_s, angle_rad, 0.1, 0.003).empty()) << "a wheel might do so";

  const TimeStretches found = jumps_against_truth(jumps, model).left;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found.front().first, 6.0, 1e-9);
  EXPECT_NEAR(found.front().second, 6.04, 1e-9);
  EXPECT_TRUE(jumps_against_truth(jumps, model).right.empty());
  EXPECT_TRUE(jumps_against_truth(slows, model).left.empty());
}

// A counter's board that restarts loses counts of both: each wheel put right alone would turn the vehicle.
TEST(EncoderJumps, AreWhereBothLoseTheSameAtOnce) {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  InnovationRun run = falls_behind(model, false);
  for (std::size_t i = 151; i < run.wheels.size(); ++i) run.wheels[i].right_rad -= 0.1;
  const JumpsOfWheels found = jumps_against_truth(run, model);
  ASSERT_EQ(found.both.size(), 1u);
  EXPECT_NEAR(found.both.front().first, 6.0, 1e-9);
  EXPECT_TRUE(found.left.empty());
  EXPECT_TRUE(found.right.empty());
}

// In a bend the inner wheel loses less than stands out by itself.
TEST(EncoderJumps, AreOfBothWheelsWhereAPacketIsLost) {
  constexpr double kFast_radps = 3.0, kSlow_radps = 0.6, kStep_s = 0.04, kCount_rad = 0.0031;
  constexpr int kLost = 150;  // the reading behind which it is
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  Random random(5);
  InnovationRun run;
  Pose pose;
  double left_rad = 0.0, right_rad = 0.0;
  for (int i = 0; i <= 300; ++i) {
    const double t = kStep_s * i;
    run.wheels.push_back(
        {t, kCount_rad * std::floor(left_rad / kCount_rad), kCount_rad * std::floor(right_rad / kCount_rad)});
    run.truth.push_back({t,
                         {pose.x_m + 0.001 * random.normal(), pose.y_m + 0.001 * random.normal()},
                         pose.heading_rad + 0.002 * random.normal()});
    const double left_step_rad = kFast_radps * kStep_s,
                 right_step_rad = (i > 100 && i < 200 ? kSlow_radps : kFast_radps) * kStep_s;
    pose = dead_reckoned(pose, left_step_rad, right_step_rad, model.drive);
    if (i == kLost) continue;
    left_rad += left_step_rad, right_rad += right_step_rad;
  }
  run.truth_has_heading = true;
  run.set_aside.assign(run.truth.size(), 0);
  const JumpsOfWheels found = jumps_against_truth(run, model);
  ASSERT_EQ(found.both.size(), 1u);
  EXPECT_NEAR(found.both.front().first, kLost * kStep_s, 1e-9);
  EXPECT_TRUE(found.left.empty());
  EXPECT_TRUE(found.right.empty());
}

// A hundredth of a second's worth of counts, as of one byte that was read wrongly; as much too many may be a bump.
TEST(EncoderJumps, AreWhereAnEvenPaceLosesLittle) {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  for (const double share : {0.25, -0.25}) {  // of 0.1 rad: a fifth of a reading
    InnovationRun run = falls_behind(model, false);
    for (std::size_t i = 151; i < run.wheels.size(); ++i) run.wheels[i].left_rad += (1.0 - share) * 0.1;
    EXPECT_EQ(jumps_against_truth(run, model).left.size(), share > 0.0 ? 1u : 0u) << share;
  }
}

// A counter that does not count for 33 ms, beginning within one reading of 40 ms and ending within the next.
TEST(EncoderJumps, AreWhereTwoReadingsInARowShareWhatIsLost) {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  for (const bool followed : {false, true}) {
    InnovationRun run = falls_behind(model, followed);
    run.wheels[151].left_rad += 0.065;  // and the rest in the next
    const TimeStretches found = jumps_against_truth(run, model).left;
    ASSERT_EQ(found.size(), followed ? 0u : 1u);
    if (followed) continue;
    EXPECT_NEAR(found.front().first, 6.0, 1e-9);
    EXPECT_NEAR(found.front().second, 6.08, 1e-9);
  }
}

// A motor that turns round crosses its play within one reading, and the vehicle stands meanwhile: no fault of a counter.
TEST(EncoderJumps, AreNotWhereWheelsTurnRoundAndCrossTheirPlay) {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  constexpr double kPlay_rad = 0.04, kTurnsRound_s = 6.0, kReads_s = 0.02;
  Random random(5);
  InnovationRun run;
  double angle_rad = 0.0;
  for (int i = 0; i <= 600; ++i) {
    const double t = kReads_s * i;
    const double play_rad = t > kTurnsRound_s + 0.5 * kReads_s ? kPlay_rad : 0.0;
    run.wheels.push_back({t, angle_rad - play_rad, angle_rad - play_rad});
    angle_rad += kReads_s * 1.5 * std::clamp(kTurnsRound_s - t - 0.5 * kReads_s, -1.0, 1.0);
  }
  for (int k = 0; k <= 1200; ++k) {
    const auto i = static_cast<std::size_t>(k / 2);
    const double play_rad = 0.01 * k > kTurnsRound_s + 0.5 * kReads_s ? kPlay_rad : 0.0;
    const double x_m = 0.1 * (run.wheels[i].left_rad + play_rad);
    run.truth.push_back(
        {0.01 * k, {x_m + 0.0005 * random.normal(), 0.0005 * random.normal()}, 0.001 * random.normal()});
  }
  run.truth_has_heading = true;
  run.set_aside.assign(run.truth.size(), 0);
  const JumpsOfWheels found = jumps_against_truth(run, model);
  EXPECT_TRUE(found.both.empty());
  EXPECT_TRUE(found.left.empty());
  EXPECT_TRUE(found.right.empty());
}

// A truth whose clock is late by a tenth of a second knows nothing yet of a wheel that stops for a moment.
TEST(EncoderJumps, AreNotWhereAWheelSlowsAndSpeedsUpAgain) {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.001, 0.002};
  InnovationRun run = falls_behind(model, false);
  const double slowed_rad[] = {0.02, 0.08, 0.1, 0.05};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 151 + k; i < run.wheels.size(); ++i) run.wheels[i].left_rad -= slowed_rad[k];
  for (std::size_t i = 151; i < run.wheels.size(); ++i) run.wheels[i].left_rad += 0.1;  // instead of the jump
  EXPECT_TRUE(jumps_against_truth(run, model).left.empty());
}

// 12 of 400 s of a day on which it drives as any robot does; and fast for so long after it crept.
TEST(EncoderJumps, AreNotWhereARobotDrivesInAThirtiethOfTheTime) {
  for (const double creeps_radps : {0.0, 0.5}) {
    Read r;
    double angle_rad = 0.0;
    for (int i = 0; i < 8000; ++i) {
      const double t = 0.05 * i, since_s = t - 380.0, wanted = 4.0 * std::clamp(since_s, 0.0, 1.0);
      r.time_s.push_back(t);
      r.angle_rad.push_back(kCount_rad * std::floor(angle_rad / kCount_rad));
      angle_rad += 0.05 * std::max(creeps_radps, since_s < 12.0 ? wanted : 0.0);
    }
    EXPECT_TRUE(jumps_of(r).empty()) << creeps_radps;
    for (std::size_t i = 7700; i < r.angle_rad.size(); ++i) r.angle_rad[i] += 3.0;
    EXPECT_EQ(jumps_of(r).size(), 1u) << creeps_radps;
  }
}

// One row of fifty is missing, and the readings are taken to be as far apart as all others. One wheel alone that makes
// two steps at once jumps.
TEST(EncoderJumps, AreNotWhereALogLostARow) {
  std::vector<WheelSample> wheels, one_jumps;
  double left_rad = 0.0, right_rad = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double pace = 6.0 + 2.0 * std::sin(0.02 * i);
    for (int lost = i % 50 == 49 ? 1 : 0; lost >= 0; --lost)
      left_rad += pace * kReading_s, right_rad += 0.7 * pace * kReading_s;
    wheels.push_back({kReading_s * i, left_rad, right_rad});
    one_jumps.push_back({kReading_s * i, left_rad, 0.7 * pace * kReading_s * i});
  }
  Read left;
  for (const WheelSample& w : wheels) left.time_s.push_back(w.time_s), left.angle_rad.push_back(w.left_rad);
  const TimeStretches jumps = jumps_of(left);
  EXPECT_EQ(jumps.size(), 7u);  // the last is at the end
  EXPECT_TRUE(without_lost_rows(jumps, wheels).empty());
  EXPECT_EQ(without_lost_rows(jumps, one_jumps).size(), jumps.size());
}

}  // namespace
}  // namespace odolab
