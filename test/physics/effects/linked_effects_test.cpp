#include <gtest/gtest.h>

#include "core/recording/vehicle_samples.h"
#include "physics/simulation.h"

namespace odolab {
namespace {

Scenario standing(const VehicleKind& kind, std::vector<ActiveEffect> effects) {
  Scenario scenario;
  scenario.vehicle.kind = kind;
  scenario.path = StraightPath{0.1, false};
  scenario.effects = std::move(effects);
  return scenario;
}

TEST(LinkedEffects, BiasesAreReadFromTheFirstSampleOn) {
  Clapper trucks;
  trucks.link_angle_resolution_rad = trucks.link_length_resolution_m = 0.0;
  const Scenario clapper = standing(trucks, {{"link_angle_bias", "truck_a", {{"bias_rad", 0.02}}},
                                             {"link_angle_bias", "truck_b", {{"bias_rad", -0.03}}},
                                             {"link_length_bias", "link", {{"bias_m", 0.002}}}});
  EXPECT_TRUE(problems_in(clapper).empty());
  const LinkedSample link = linked_samples(Simulation(clapper, 1).recording()).front();
  EXPECT_NEAR(link.link_angle_a_rad, 0.02, 1e-12);
  EXPECT_NEAR(link.link_angle_b_rad, -0.03, 1e-12);
  EXPECT_NEAR(link.link_length_m, 1.002, 1e-12);

  SmartEncoderTrailer train;
  train.hitch_angle_resolution_rad = 0.0;
  const Scenario towed = standing(train, {{"link_angle_bias", "trailer", {{"bias_rad", 0.04}}}});
  EXPECT_NEAR(trailer_samples(Simulation(towed, 1).recording()).front().hitch_angle_rad, 0.04, 1e-12);

  MultiCastor castors = three_castor_vehicle();
  castors.pivot_encoder_resolution_rad = 0.0;
  const Scenario platform = standing(castors, {{"pivot_angle_bias", "castor2", {{"bias_rad", 0.05}}}});
  const CastorSample sample = castor_samples(Simulation(platform, 1).recording(), 3).front();
  EXPECT_NEAR(sample.castors[0].pivot_rad, 0.0, 1e-12);
  EXPECT_NEAR(sample.castors[1].pivot_rad, 0.05, 1e-12);
}

TEST(LinkedEffects, AVehicleWithoutThePartIsToldSo) {
  const Scenario labmate = standing(DifferentialDrive{}, {{"link_length_bias", "link", {{"bias_m", 0.002}}}});
  ASSERT_EQ(problems_in(labmate).size(), 1u);
  EXPECT_EQ(
      problems_in(labmate).front(),
      "effect: found 'link_length_bias' on link, which this kind of vehicle does not have, expected one of its own "
      "parts");
}

// Section 5.2: with truck A's encoder reading too little and B's too much, both by d, "straight" is a circle: the
// trucks stand at +d and -d to the link, and it turns by 2 d for each of its lengths.
TEST(LinkedEffects, BiasedRotaryEncodersBendTheStraightWay) {
  constexpr double kBias_rad = 0.01;
  Clapper trucks;
  trucks.link_angle_resolution_rad = trucks.link_length_resolution_m = 0.0;
  trucks.truck_a.encoder_counts_per_revolution = trucks.truck_b.encoder_counts_per_revolution = 1e12;
  Scenario scenario = standing(trucks, {{"link_angle_bias", "truck_a", {{"bias_rad", -kBias_rad}}},
                                        {"link_angle_bias", "truck_b", {{"bias_rad", kBias_rad}}}});
  scenario.path = StraightPath{6.0, false};
  scenario.sensors.encoder_period_s = 0.040;
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 120.0);
  ASSERT_TRUE(simulation.state().finished);
  const double lost_rad = simulation.state().true_pose.heading_rad - simulation.state().estimated_pose.heading_rad;
  // It settles within the first half of a metre, so a tenth of 6 m is the tolerance.
  EXPECT_NEAR(lost_rad, 2.0 * kBias_rad * 6.0 / trucks.link_length_m, 0.1 * 2.0 * kBias_rad * 6.0);
}

// A tenth of the counts is lost where it was said, and nowhere else.
TEST(LinkedEffects, OneWheelOfOneTruckMissesItsCounts) {
  for (const char* const truck : {"truck_a", "truck_b"}) {
    Scenario scenario = standing(Clapper{}, {{"encoder_missed_counts",
                                              truck + std::string(".left_wheel"),  //
                                              {{"fraction", 0.1}}}});
    scenario.sensors.encoder_period_s = 0.040;
    ASSERT_TRUE(problems_in(scenario).empty()) << problems_in(scenario).front();
    Simulation simulation(scenario, 1);
    run_to_end(simulation, 60.0);
    const WheelState left = simulation.state().left, right = simulation.state().right;  // of truck A
    ASSERT_GT(std::abs(left.rotation_rad), 1.0);
    const double share = std::string(truck) == "truck_a" ? 0.9 : 1.0;
    EXPECT_NEAR(left.counted_rad, share * left.rotation_rad, 1e-9);
    EXPECT_NEAR(right.counted_rad, right.rotation_rad, 1e-9);
  }
}

// A trailer is drawn along, whatever its encoders say.
TEST(LinkedEffects, ATrailersWheelMissesItsCountsAndTheTrailerKeepsItsWay) {
  std::vector<TrailerSample> last;
  for (const double fraction : {0.0, 0.1}) {
    SmartEncoderTrailer train;
    train.trailer.encoder_counts_per_revolution = 1e9;
    Scenario scenario = standing(train, {{"encoder_missed_counts", "trailer.right_wheel", {{"fraction", fraction}}}});
    scenario.driving.internal_correction = false;
    ASSERT_TRUE(problems_in(scenario).empty());
    Simulation simulation(scenario, 1);
    run_to_end(simulation, 60.0);
    last.push_back(trailer_samples(simulation.recording()).back());
  }
  const double rolled_rad = last[0].trailer.right_rad;
  ASSERT_GT(rolled_rad, 1.0);
  EXPECT_NEAR(last[1].trailer.right_rad, 0.9 * rolled_rad, 1e-6);
  EXPECT_NEAR(last[1].trailer.left_rad, last[0].trailer.left_rad, 1e-6);
}

TEST(LinkedEffects, AreOfPartsThatTheVehicleHas) {
  const auto problems = [](const VehicleKind& kind, const std::string& effect, const std::string& component) {
    return problems_in(standing(kind, {{effect, component, {{"amplitude", 0.01}}}})).size();
  };
  EXPECT_EQ(problems(Clapper{}, "wheel_eccentricity", "truck_b.left_wheel"), 0u);
  EXPECT_EQ(problems(three_castor_vehicle(), "wheel_eccentricity", "castor3.right_wheel"), 0u);
  EXPECT_EQ(problems(three_castor_vehicle(), "wheel_eccentricity", "castor4.right_wheel"), 1u);
  EXPECT_EQ(problems(Clapper{}, "wheel_eccentricity", "left_wheel"), 1u);
  EXPECT_EQ(problems(DifferentialDrive{}, "wheel_eccentricity", "truck_a.left_wheel"), 1u);
  EXPECT_EQ(problems(EncoderTrailer{}, "wheel_eccentricity", "left_wheel"), 1u);  // it has tracks
}

}  // namespace
}  // namespace odolab
