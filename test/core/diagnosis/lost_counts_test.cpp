#include "core/diagnosis/quality/lost_counts.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/diagnosis/quality/quality.h"
#include "core/geometry/track.h"
#include "core/odometry/differential_drive.h"

namespace odolab {
namespace {

constexpr double kFrom_s = 6.0, kTo_s = 6.72, kLostReading_s = 0.04;

InnovationModel believed() {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  model.noise = {0.0005, 0.05, 0.05};
  return model;
}

// Straight on for twelve seconds, faster and faster, up to 0.6 m/s; the counters of some wheels hold for 0.7 s. A radio
// that errs by 5 cm ten times a second says where the vehicle was; `stood`: it stood meanwhile.
InnovationRun run_holding(bool left, bool right, bool stood, double to_s = kTo_s,
                          const InnovationModel& model = believed()) {
  Random random(5);
  InnovationRun run;
  Track way;
  Pose pose;
  double left_rad = 0.0, right_rad = 0.0;
  for (int i = 0; i <= 300; ++i) {
    const double t = kLostReading_s * i, by_rad = kLostReading_s * 0.5 * t;
    const bool holds = t > kFrom_s && t < to_s;
    if (!holds || !left) left_rad += by_rad;
    if (!holds || !right) right_rad += by_rad;
    run.wheels.push_back({t, left_rad, right_rad});
    const double true_rad = holds && stood ? 0.0 : by_rad;
    pose = dead_reckoned(pose, true_rad, true_rad, model.drive);
    way.push_back({t, pose});
  }
  for (int k = 0; k <= 120; ++k) {
    const Pose at = *pose_at(way, 0.1 * k);
    run.truth.push_back({0.1 * k,
                         {at.x_m + model.noise.truth_position_m * random.normal(),
                          at.y_m + model.noise.truth_position_m * random.normal()},
                         at.heading_rad + model.noise.truth_heading_rad * random.normal()});
  }
  run.truth_has_heading = true;
  run.set_aside.assign(run.truth.size(), 0);
  return run;
}

TEST(LostCounts, AreThoseOfBothWheelsWhereTheTruthGoesOn) {
  const JumpsOfWheels found = lost_counts(run_holding(true, true, false), believed());
  ASSERT_EQ(found.both.size(), 1u);
  EXPECT_NEAR(found.both[0].first, kFrom_s, kLostReading_s);
  EXPECT_NEAR(found.both[0].second, kTo_s, kLostReading_s);
  EXPECT_TRUE(found.left.empty());
  EXPECT_TRUE(found.right.empty());
}

// A station that errs by 1.5 mm knows it of a single reading, at which no two wheels stop from 0.3 m/s and go on, nor one
// while the other goes on: it was a push, or what happens at one place.
TEST(LostCounts, AreThoseOfASingleReading) {
  InnovationModel by_a_station = believed();
  by_a_station.noise.truth_position_m = 0.0015;
  by_a_station.noise.truth_heading_rad = 0.003;
  constexpr double kOneReading_s = kFrom_s + 1.5 * kLostReading_s;
  const auto found = [&](bool left, bool right, bool stood) {
    return lost_counts(run_holding(left, right, stood, kOneReading_s, by_a_station), by_a_station);
  };
  const JumpsOfWheels of_both = found(true, true, false);
  ASSERT_EQ(of_both.both.size(), 1u);
  EXPECT_NEAR(of_both.both[0].first, kFrom_s, kLostReading_s);
  EXPECT_TRUE(found(true, true, true).both.empty());
  const JumpsOfWheels of_one = found(true, false, false);
  ASSERT_EQ(of_one.left.size(), 1u);
  EXPECT_NEAR(of_one.left[0].first, kFrom_s, kLostReading_s);
  EXPECT_TRUE(of_one.right.empty() && of_one.both.empty());
}

// A vehicle that swings about a wheel which catches on something, as the other goes on.
TEST(LostCounts, AreNoneOfAWheelAboutWhichTheVehicleTurns) {
  InnovationModel by_a_station = believed();
  by_a_station.noise.truth_position_m = 0.0015;
  by_a_station.noise.truth_heading_rad = 0.003;
  InnovationRun run = run_holding(true, false, false, kFrom_s + 1.5 * kLostReading_s, by_a_station);
  const DifferentialDrive& drive = by_a_station.drive;
  Track way;
  Pose pose;
  way.push_back({run.wheels.front().time_s, pose});
  for (std::size_t i = 1; i < run.wheels.size(); ++i) {
    pose = dead_reckoned(pose, run.wheels[i].left_rad - run.wheels[i - 1].left_rad,
                         run.wheels[i].right_rad - run.wheels[i - 1].right_rad, drive);
    way.push_back({run.wheels[i].time_s, pose});
  }
  for (TruthSample& t : run.truth) {
    const Pose at = *pose_at(way, t.time_s);
    t.position = {at.x_m, at.y_m};
    t.heading_rad = at.heading_rad;
  }
  const JumpsOfWheels found = lost_counts(run, by_a_station);
  EXPECT_TRUE(found.left.empty() && found.both.empty());
}

// A vehicle that is elsewhere when it is seen again may have been carried there.
TEST(LostCounts, AreNoneWhereTheTruthWasNotTakenMeanwhile) {
  InnovationRun run = run_holding(true, true, false);
  std::erase_if(run.truth, [](const TruthSample& t) { return t.time_s > kFrom_s - 0.05 && t.time_s < kTo_s + 0.05; });
  run.set_aside.assign(run.truth.size(), 0);
  EXPECT_TRUE(lost_counts(run, believed()).both.empty());
}

TEST(LostCounts, AreThoseOfOneWheelWhereTheTruthKeepsItsDirection) {
  EXPECT_EQ(lost_counts(run_holding(true, false, false), believed()).left.size(), 1u);
  EXPECT_EQ(lost_counts(run_holding(false, true, false), believed()).right.size(), 1u);
}

// A simulator's vehicle may stop within one reading.
TEST(LostCounts, AreNoneWhereTheVehicleStood) {
  const JumpsOfWheels found = lost_counts(run_holding(true, true, true), believed());
  EXPECT_TRUE(found.both.empty() && found.left.empty() && found.right.empty());
}

// No truth on the way has to say it: no wheel turns by four radians in one reading.
TEST(Checked, FindsACounterThatJumpsWhereOnlyTheEndsWereMeasured) {
  const InnovationRun run = run_holding(false, false, false);
  Recording recording;
  recording.name = "ends.csv";
  for (const char* name : {"left_wheel_rad", "right_wheel_rad", "truth_x_m", "truth_y_m", "truth_heading_rad"})
    recording.add_channel(name);
  constexpr std::size_t kAt = 150;
  constexpr double kJump_rad = 4.0;
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    recording.time_s.push_back(run.wheels[i].time_s);
    const bool is_end = i == 0 || i + 1 == run.wheels.size();
    const double none = std::nan("");
    const double values[] = {run.wheels[i].left_rad + (i > kAt ? kJump_rad : 0.0), run.wheels[i].right_rad,
                             is_end ? (i == 0 ? 0.0 : 4.2) : none, is_end ? 0.0 : none, is_end ? 0.0 : none};
    for (std::size_t k = 0; k < recording.channels.size(); ++k) recording.channels[k].values.push_back(values[k]);
  }
  Vehicle vehicle;
  vehicle.kind = believed().drive;
  const CheckedRecording ready = checked(recording, vehicle);
  ASSERT_EQ(ready.faults.size(), 1u);
  EXPECT_EQ(ready.faults[0].component, "left_wheel");
  ASSERT_EQ(ready.left_out_s.size(), 1u);
  EXPECT_NEAR(ready.left_out_s[0].first, recording.time_s[kAt], 1e-9);
}

}  // namespace
}  // namespace odolab
