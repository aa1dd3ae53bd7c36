// Effects on what is read, when, and what is written down.
#include <gtest/gtest.h>

#include "core/scenario/effect_catalogue.h"
#include "physics/effects/effects.h"
#include "physics/replay.h"
#include "test/physics/effects/effect_runs.h"

namespace odolab {
namespace {

Recording recorded_scenario(const Scenario& scenario) { return finished(scenario).recording(); }

const std::vector<WheelSpeeds> kStraight = {phase(10.0, 0.2, 0.0)};

TEST(Effects, EveryEntryOfTheCatalogueActsInThePlanarWorld) {
  for (const EffectEntry& entry : effect_catalogue()) EXPECT_TRUE(planar::has_effect(entry.name)) << entry.name;
}

TEST(ClockRate, StampsOfTheRobotGrowTooFastAndThoseOfTheTruthDoNot) {
  const Recording plain = recorded_scenario(table_drive(kStraight, {}));
  const Recording fast = recorded_scenario(table_drive(kStraight, {{"clock_rate", "vehicle", {{"rate", 0.01}}}}));
  const auto wheels = wheel_samples(plain, {}), stretched = wheel_samples(fast, {});
  ASSERT_EQ(wheels.size(), stretched.size());
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    EXPECT_NEAR(stretched[i].time_s, 1.01 * wheels[i].time_s, 1e-12);
    EXPECT_EQ(stretched[i].left_rad, wheels[i].left_rad);
  }
  EXPECT_EQ(truth_samples(fast).back().time_s, truth_samples(plain).back().time_s);
  EXPECT_TRUE(problems_in(fast).empty());
}

TEST(TruthTimeOffset, StampsAreLate) {
  const auto plain = truth_samples(recorded_scenario(table_drive(kStraight, {})));
  for (const double offset_s : {0.035, -0.035}) {
    const Recording recording =
        recorded_scenario(table_drive(kStraight, {{"truth_time_offset", "truth", {{"offset_s", offset_s}}}}));
    const auto late = truth_samples(recording);
    ASSERT_EQ(late.size(), plain.size());
    EXPECT_NEAR(late[500].time_s - plain[500].time_s, offset_s, 1e-12);
    EXPECT_EQ(late[500].position.x_m, plain[500].position.x_m);
    EXPECT_TRUE(problems_in(recording).empty());
  }
}

TEST(TruthMountingOffset, MeasuresAnotherPointOfTheVehicle) {
  Scenario scenario =
      table_drive({phase(5.0, 0.0, 0.5)},
                  {{"truth_mounting_offset", "truth", {{"x_m", 0.1}, {"y_m", -0.02}, {"heading_rad", 0.3}}}});
  const Simulation s = finished(scenario);
  const Recording recording = s.recording();  // a temporary would not live as long as its samples are looked at
  const TruthSample last = truth_samples(recording).back();
  const Pose expected = s.state().true_pose * Pose{0.1, -0.02, 0.3};
  EXPECT_NEAR(length(last.position - expected.position()), 0.0, 1e-12);
  EXPECT_NEAR(*last.heading_rad, expected.heading_rad, 1e-12);
}

// Straight on at 0.2 m/s it is behind by as far as the vehicle goes in the filter's time constant, once that has
// passed.
TEST(TruthSmoothing, IsLateByTheTimeConstantOfItsFilter) {
  const auto plain = truth_samples(recorded_scenario(table_drive(kStraight, {})));
  const auto late =
      truth_samples(recorded_scenario(table_drive(kStraight, {{"truth_smoothing", "truth", {{"width_s", 0.1}}}})));
  ASSERT_EQ(late.size(), plain.size());
  EXPECT_NEAR(plain[800].position.x_m - late[800].position.x_m, 0.1 * 0.2, 1e-5);
  EXPECT_EQ(late[800].time_s, plain[800].time_s);
  EXPECT_EQ(late[0].position.x_m, plain[0].position.x_m);
}

TEST(TruthFrozen, RepeatsItselfForItsStretchesWithNewStamps) {
  const auto truth = truth_samples(
      recorded_scenario(table_drive(kStraight, {{"truth_frozen", "truth", {{"every_s", 3.0}, {"lasts_s", 0.5}}}})));
  int repeated = 0;
  for (std::size_t i = 1; i < truth.size(); ++i)
    if (truth[i].position.x_m == truth[i - 1].position.x_m && truth[i].time_s > 1.0 && truth[i].time_s < 10.0) {
      ++repeated;
      const double into_s = std::fmod(truth[i].time_s + 1e-9, 3.0);
      EXPECT_LT(into_s, 0.5) << truth[i].time_s;
    }
  EXPECT_EQ(repeated, 3 * 50);  // at 3, 6 and 9 s, for half a second of 100 Hz each
}

TEST(EncoderDataFault, FreezesOrStepsBackwardAndIsRightAgain) {
  const auto plain = wheel_samples(recorded_scenario(table_drive(kStraight, {})), {});
  const auto faulty = wheel_samples(
      recorded_scenario(table_drive(
          kStraight, {{"encoder_data_fault", "left_wheel", {{"at_s", 4.0}, {"lasts_s", 0.2}, {"backward_rad", 0.5}}}})),
      {});
  ASSERT_EQ(plain.size(), faulty.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const bool fault = plain[i].time_s > 4.0 - 1e-6 && plain[i].time_s < 4.2 - 1e-6;
    EXPECT_EQ(faulty[i].left_rad, fault ? plain[199].left_rad - 0.5 : plain[i].left_rad) << plain[i].time_s;
    EXPECT_EQ(faulty[i].right_rad, plain[i].right_rad);
  }
}

TEST(Sensors, RecordWhatTheyAreToldTo) {
  Scenario scenario;
  scenario.path = StraightPath{1.0, false};
  scenario.sensors.record_encoders = false;
  scenario.sensors.record_commands = true;
  scenario.sensors.truth_heading = false;
  const Recording recording = recorded_scenario(scenario);
  EXPECT_EQ(recording.channel("left_wheel_rad"), nullptr);
  EXPECT_EQ(recording.channel("truth_heading_rad"), nullptr);
  const auto commands = command_samples(recording);
  double way_m = 0.0;
  for (std::size_t i = 0; i + 1 < commands.size(); ++i)
    way_m += commands[i].speed_mps * (commands[i + 1].time_s - commands[i].time_s);
  // The driver asks until the encoders say that the metre is driven; the motors lag by their integral's share of the
  // ramps.
  EXPECT_NEAR(way_m, 1.0, 0.01);
}

// As the driver's ramps had been written down, the base seemed half a period late: 10 ms, or 2 mm at 0.2 m/s.
TEST(Sensors, RecordCommandsThatHeldUntilTheNextGoWhereTheBaseGoes) {
  Scenario scenario;
  scenario.path = StraightPath{1.0, false};
  scenario.motor.ideal = true;
  scenario.sensors.record_commands = true;
  const Recording recording = recorded_scenario(scenario);
  const auto commands = command_samples(recording);
  const auto truth = truth_samples(recording);
  double way_m = 0.0;
  std::size_t t = 0;
  for (std::size_t i = 0; i + 1 < commands.size(); ++i) {
    while (truth[t].time_s < commands[i].time_s - 1e-9) ++t;
    // Both at the same stamp; the tread's creep at 0.2 m/s2 is what differs.
    EXPECT_NEAR(truth[t].position.x_m - truth[0].position.x_m, way_m, 2e-4) << commands[i].time_s;
    way_m += commands[i].speed_mps * (commands[i + 1].time_s - commands[i].time_s);
  }
  EXPECT_GT(way_m, 0.9);
}

// A recording with an effect, replayed with the same effect, follows its own truth; without it does not.
TEST(Effects, FoundInARecordingExplainItInAReplay) {
  const std::vector<ActiveEffect> cases[] = {
      {{"wheel_eccentricity", "left_wheel", {{"amplitude", 0.02}}}},
      {{"encoder_missed_counts", "left_wheel", {{"fraction", 0.01}, {"above_radps", 3.0}}}},
      {{"clock_rate", "vehicle", {{"rate", 0.01}}}},
      {{"truth_time_offset", "truth", {{"offset_s", 0.08}}}},
      {{"truth_mounting_offset", "truth", {{"x_m", 0.08}}}},
      {{"payload_radius_change", "vehicle", {{"left", 0.01}, {"right", -0.01}, {"at_s", 8.0}}}},
      {{"turn_scrub", "vehicle", {{"per_radps", 0.04}}}},
      {{"traction_slip", "both_wheels", {{"per_mps2", 0.1}}}},
      {{"lateral_slip", "vehicle", {{"m_per_s_per_mps2", 0.03}}}},
      {{"tyre_compression", "vehicle", {{"radius_change_m_per_mps2", 0.002}}}},
      {{"speed_dependent_radius", "right_wheel", {{"per_mps", 0.02}}}},
      {{"radius_drift", "left_wheel", {{"per_s", 1e-3}}}},
      {{"one_sided_drag", "vehicle", {{"rad_per_m", 0.01}}}},
      {{"castor_reversal_kick", "vehicle", {{"kick_rad", 0.02}}}},
      {{"floor_slope_creep", "floor", {{"creep_mps", 0.002}}}},
      {{"collision", "vehicle", {{"dx_m", 0.05}, {"dheading_rad", 0.02}, {"at_s", 5.0}}}},
      {{"turn_speed_loss", "vehicle", {{"per_radps", 0.03}}}},
      {{"drivetrain_backlash", "both_wheels", {{"gap_rad", 0.1}}}}};
  for (const std::vector<ActiveEffect>& effects : cases) {
    Scenario scenario = table_drive(
        {phase(4.0, 0.4, 0.0), phase(4.0, 0.4, 0.6), phase(4.0, -0.4, 0.3), phase(4.0, 0.2, -0.9)}, effects);
    const auto recording = std::make_shared<const Recording>(recorded_scenario(scenario));
    Scenario again = replay_scenario(scenario.vehicle, *recording);
    const Result<Replay> without = replay(again, recording);
    again.effects = effects;
    const Result<Replay> with = replay(again, recording);
    ASSERT_TRUE(without && with);
    // The encoders' counts, 0.12 mm and 0.7 mrad, and what lies between two readings 20 ms apart.
    EXPECT_LT(with->simulated_error->largest_position_m, 4e-3) << effects[0].effect;
    EXPECT_GT(without->simulated_error->largest_position_m, 1.5 * with->simulated_error->largest_position_m)
        << effects[0].effect;
  }
}

}  // namespace
}  // namespace odolab
