#include "physics/vehicles/vehicle_shape.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/io/vehicle_toml.h"
#include "core/scenario/suited_scenario.h"
#include "physics/simulation.h"
#include "source_dir.h"

namespace odolab {
namespace {

const char* const kShapedVehicles[] = {"andros",  "andros_with_trailer",        "clapper",  "k2a",
                                       "labmate", "labmate_with_smart_trailer", "omnimate", "three_castors"};

Scenario with_file(const std::string& name) {
  const Result<Vehicle> vehicle = read_vehicle(std::string(ODOLAB_SOURCE_DIR) + "/assets/vehicles/" + name + ".toml");
  EXPECT_TRUE(vehicle) << name;
  return with_vehicle(Scenario{}, *vehicle);
}

// Where a wheel stands on the floor.
Vec2 place_of(const VehicleShape& shape, const VehiclePosture& posture, std::size_t wheel) {
  const WheelShape& w = shape.wheels[wheel];
  return posture.bodies[std::size_t(w.body)] * w.place;
}

TEST(VehicleShape, OfEveryKindHasAPartForEachPartThatMoves) {
  for (const char* file : kShapedVehicles) {
    Simulation simulation(with_file(file), 1);
    const VehicleShape shape = simulation.shape();
    run_to_end(simulation, 0.2);
    const VehiclePosture posture = simulation.posture();
    ASSERT_EQ(posture.bodies.size(), shape.bodies.size()) << file;
    ASSERT_EQ(posture.wheels.size(), shape.wheels.size()) << file;
    ASSERT_EQ(posture.gauges.size(), shape.gauges.size()) << file;
    EXPECT_GE(shape.wheels.size(), 2u) << file;
    for (const WheelShape& wheel : shape.wheels) {
      EXPECT_LT(std::size_t(wheel.body), shape.bodies.size()) << file;
      EXPECT_GT(wheel.radius_m, 0.0) << file;
      EXPECT_GT(wheel.width_m, 0.0) << file;
    }
    for (const GaugeShape& gauge : shape.gauges)
      if (!gauge.channel.empty()) {
        EXPECT_EQ(std::count(simulation.channels().begin(), simulation.channels().end(), gauge.channel), 1)
            << file << ": " << gauge.name;
      }
  }
}

TEST(VehicleShape, StandsOnWheelsAsFarApartAsTheVehicleFileSays) {
  const Simulation clapper(with_file("clapper"), 1);
  const VehicleShape shape = clapper.shape();
  const VehiclePosture posture = clapper.posture();
  // Wheelbase 0.34 m; truck B a link of 1 m behind. Rounding of doubles.
  EXPECT_NEAR(length(place_of(shape, posture, 0) - place_of(shape, posture, 1)), 0.34, 1e-12);
  EXPECT_NEAR(place_of(shape, posture, 0).x_m - place_of(shape, posture, 2).x_m, 1.0, 1e-12);

  const Simulation castors(with_file("three_castors"), 1);
  const VehicleShape castor_shape = castors.shape();
  const VehiclePosture castor_posture = castors.posture();
  // The first pivot is 0.25 m ahead, its axle 0.05 m behind it, its left wheel 0.06 m beside that.
  EXPECT_NEAR(place_of(castor_shape, castor_posture, 0).x_m, 0.20, 1e-12);
  EXPECT_NEAR(place_of(castor_shape, castor_posture, 0).y_m, 0.06, 1e-12);
}

TEST(VehicleShape, ShowsTheTruthBesideWhatABiasedEncoderReads) {
  Scenario scenario = with_file("clapper");
  Clapper actual = std::get<Clapper>(scenario.vehicle.kind);
  actual.link_angle_a_offset_rad = 0.1;
  actual.link_length_offset_m = 0.002;
  scenario.machine.lengths = actual;
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 1.0);
  const VehiclePosture posture = simulation.posture();
  // Within half a step of the encoders: 0.0026 rad, 0.05 mm.
  EXPECT_NEAR(posture.gauges[0].measured - posture.gauges[0].truth, 0.1, 0.0026 + 1e-9);
  EXPECT_NEAR(posture.gauges[2].measured - posture.gauges[2].truth, 0.002, 0.00005 + 1e-9);
}

TEST(VehicleShape, OfASynchroDriveTurnsItsWheelsUnderABaseThatKeepsItsDirection) {
  Scenario scenario = with_file("k2a");
  scenario.path = HandPath{10.0};
  Simulation simulation(scenario, 1);
  simulation.drive_by_hand(0.0, 0.5);
  run_to_end(simulation, 3.0);
  const VehiclePosture posture = simulation.posture();
  EXPECT_GT(posture.wheels[0].steered_rad, 1.0);
  EXPECT_LT(std::abs(posture.bodies[0].heading_rad), 0.02);  // alike wheels turn it by nothing but a little creep
  EXPECT_NEAR(posture.reference.heading_rad, posture.bodies[0].heading_rad + posture.wheels[0].steered_rad, 1e-12);
}

TEST(VehicleShape, BetweenTwoMomentsIsInTheMiddleOfBoth) {
  VehiclePosture a, b;
  a.bodies = {{0.0, 0.0, 0.0}};
  b.bodies = {{1.0, 2.0, 0.5}};
  a.wheels.resize(1);
  b.wheels.resize(1);
  b.wheels[0].rotation_rad = 3.0;
  b.wheels[0].on_bump = true;
  const VehiclePosture half = between(a, b, 0.5);
  EXPECT_DOUBLE_EQ(half.bodies[0].y_m, 1.0);
  EXPECT_DOUBLE_EQ(half.wheels[0].rotation_rad, 1.5);
  EXPECT_TRUE(half.wheels[0].on_bump);
  EXPECT_FALSE(between(a, b, 0.49).wheels[0].on_bump);
}

}  // namespace
}  // namespace odolab
