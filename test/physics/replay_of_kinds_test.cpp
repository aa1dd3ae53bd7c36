#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "core/io/vehicle_toml.h"
#include "core/recording/vehicle_samples.h"
#include "core/scenario/suited_scenario.h"
#include "physics/replay.h"
#include "physics/simulation.h"
#include "source_dir.h"
#include "test/support/finished_run.h"

namespace odolab {
namespace {

const char* const kVehicleFiles[] = {"andros",  "andros_with_trailer",        "clapper",  "k2a",
                                     "labmate", "labmate_with_smart_trailer", "omnimate", "three_castors"};

// A short drive with a corner, on a plain floor.
Scenario corner(const std::string& file) {
  const Result<Vehicle> vehicle = read_vehicle(std::string(ODOLAB_SOURCE_DIR) + "/assets/vehicles/" + file + ".toml");
  EXPECT_TRUE(vehicle) << file;
  Scenario scenario = with_vehicle(Scenario{}, *vehicle);
  scenario.path = WaypointPath{{{1.0, 0.0}, {1.0, 1.0}}};
  scenario.step_s = 0.002;
  return scenario;
}

Recording recorded_with_seed(const Scenario& scenario) { return finished(scenario, 3).recording(); }

Scenario replaying(const Scenario& scenario, const Recording& recording) {
  Scenario again = scenario;
  again.path = replay_scenario(scenario.vehicle, recording).path;
  return again;
}

TEST(Replay, OfEveryKindTurnsItsWheelsAsTheyWereRecordedAndComesWhereItWas) {
  for (const char* file : kVehicleFiles) {
    const Scenario scenario = corner(file);
    const auto recording = std::make_shared<const Recording>(recorded_with_seed(scenario));
    const Scenario again = replaying(scenario, *recording);
    ASSERT_EQ(std::get<ReplayPath>(again.path).by, ReplayPath::By::wheels) << file;
    ASSERT_TRUE(problems_in(again).empty()) << file << ": " << problems_in(again).front();
    const Result<Replay> result = replay(again, recording, {}, 0.1);
    ASSERT_TRUE(result) << file << ": " << result.error().message();
    ASSERT_TRUE(result->simulated_error) << file;
    // The same physics, but wheels rounded to counts: a count of the K2A's steering is 3 mrad, which leads a metre 3 mm
    // astray; a step of the castors' wheels is 0.26 mm, and six of them push against each other where they disagree.
    EXPECT_LT(result->simulated_error->end_position_m, 0.008) << file;
    EXPECT_FALSE(result->postures.empty()) << file;
    EXPECT_EQ(result->postures.back().posture.bodies.size(), result->shape.bodies.size()) << file;
  }
}

// A recording that begins in the middle of a drive, with a row in which encoders and truth were read.
Recording from(const Recording& whole, double begin_s) {
  Recording rest;
  rest.name = whole.name;
  for (const Channel& channel : whole.channels) rest.channels.push_back({channel.name, {}});
  for (std::size_t i = 0; i < whole.time_s.size(); ++i) {
    if (rest.time_s.empty() && (whole.time_s[i] < begin_s || std::isnan(whole.channels[0].values[i]))) continue;
    rest.time_s.push_back(whole.time_s[i]);
    for (std::size_t c = 0; c < whole.channels.size(); ++c)
      rest.channels[c].values.push_back(whole.channels[c].values[i]);
  }
  return rest;
}

TEST(Replay, ThatBeginsInTheMiddleOfADriveBeginsAsItStoodAndMoved) {
  for (const char* file : kVehicleFiles) {
    Scenario scenario = corner(file);
    const Recording whole = recorded_with_seed(scenario);
    const auto second_half = std::make_shared<const Recording>(from(whole, 0.5 * whole.duration_s()));
    const Scenario again = replaying(scenario, *second_half);
    Simulation simulation(again, 1, second_half);
    const VehiclePosture begin = simulation.posture();
    for (std::size_t i = 0; i < begin.gauges.size(); ++i)  // a step of the encoder, 0.3 degrees, and the spring
      if (!std::isnan(begin.gauges[i].measured)) {
        EXPECT_NEAR(begin.gauges[i].measured, begin.gauges[i].truth, 0.006) << file << " " << i;
      }
    const Result<Replay> result = replay(again, second_half);
    ASSERT_TRUE(result) << file;
    // As from its beginning; tracks, in the middle of a skidding turn, begin in the turn that their nominal vehicle
    // takes it for: off by half of 0.7 rad/s until they have slipped into the true one, some hundredths of a second.
    const bool tracked = std::string(file).find("andros") == 0;
    EXPECT_LT(result->simulated_error->end_position_m, tracked ? 0.012 : 0.004) << file;
  }
}

TEST(Replay, OfAnotherKindFollowsCommandsToo) {
  Scenario scenario = corner("k2a");
  scenario.sensors.record_commands = true;
  scenario.sensors.record_encoders = false;
  const auto recording = std::make_shared<const Recording>(recorded_with_seed(scenario));
  const Scenario again = replaying(scenario, *recording);
  ASSERT_EQ(std::get<ReplayPath>(again.path).by, ReplayPath::By::commands);
  const Result<Replay> result = replay(again, recording);
  ASSERT_TRUE(result);
  // Commands held for 20 ms instead of led evenly from one to the next: half a period of 0.2 m/s is 2 mm.
  EXPECT_LT(result->simulated_error->end_position_m, 0.02);
}

TEST(Replay, SaysWhichColumnsAreMissingForAKind) {
  const Scenario clapper = corner("clapper");
  Recording recording = recorded_with_seed(clapper);
  for (Channel& channel : recording.channels)
    if (channel.name == "link_length_m")
      channel.values.assign(channel.values.size(), std::numeric_limits<double>::quiet_NaN());
  const Result<Replay> result = replay(replaying(clapper, recording), std::make_shared<const Recording>(recording));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message().find("link_length_m"), std::string::npos) << result.error().message();
}

}  // namespace
}  // namespace odolab
