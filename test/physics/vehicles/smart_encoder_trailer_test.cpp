#include <gtest/gtest.h>

#include "core/odometry/ipec.h"
#include "physics/ground.h"
#include "physics/simulation.h"

namespace odolab {
namespace {

// Without steps in its encoders.
Scenario labmate_with_trailer(Path path) {
  Scenario scenario;
  SmartEncoderTrailer train;
  train.tow.encoder_counts_per_revolution = train.trailer.encoder_counts_per_revolution = 1e12;
  train.hitch_angle_resolution_rad = 0.0;
  scenario.vehicle.kind = train;
  scenario.path = std::move(path);
  scenario.sensors.encoder_period_s = 0.040;
  scenario.driving.internal_correction = false;
  return scenario;
}

TEST(SmartEncoderTrailer, TrailerWheelsRollWithoutSlipAndStayBehindTheHitch) {
  Scenario scenario = labmate_with_trailer(FigureEightPath{1.5, 1});
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 300.0);
  ASSERT_TRUE(simulation.state().finished);
  const Pose& trailer = simulation.state().other_bodies.front();
  EXPECT_LT(length(trailer * Vec2{1.0, 0.0} - simulation.state().true_pose.position()), 1e-9);  // the pin
  // The trailer's own odometry from its counts alone ends where it stands: exact but for the middle heading over 40 ms.
  const std::vector<TrailerSample> samples = trailer_samples(simulation.recording());
  const SmartEncoderTrailer& train = std::get<SmartEncoderTrailer>(scenario.vehicle.kind);
  Pose reckoned{-1.0, 0.0, 0.0};
  for (std::size_t i = 1; i < samples.size(); ++i)
    reckoned = dead_reckoned(reckoned, samples[i].trailer.left_rad - samples[i - 1].trailer.left_rad,
                             samples[i].trailer.right_rad - samples[i - 1].trailer.right_rad, train.trailer);
  EXPECT_LT(length(reckoned.position() - trailer.position()), 0.1e-3);
  EXPECT_NEAR(samples.back().hitch_angle_rad, wrapped(simulation.state().true_pose.heading_rad - trailer.heading_rad),
              1e-9);
}

TEST(SmartEncoderTrailer, CorrectsWheelbaseWheelRatioAndBumpsOnTheSquare) {
  // Section 4.6: 337 mm instead of 340, diameters 0.9985 to one, ten bumps of 10 mm under the inside wheel of the first
  // leg, roughness of 0 to 1 mm every 2 cm.
  double lost_rad[2];
  for (const bool corrected : {false, true}) {
    Scenario scenario;
    SmartEncoderTrailer train;
    scenario.vehicle.kind = train;
    train.tow.wheelbase_m = 0.337;
    train.tow.wheel_radius_right_m = 0.075 * 2.0 * 0.9985 / 1.9985;
    train.tow.wheel_radius_left_m = 0.075 * 2.0 / 1.9985;
    scenario.machine.lengths = train;
    scenario.sensors.encoder_period_s = 0.040;
    scenario.driving.internal_correction = corrected;
    scenario.floor.roughness.largest_height_m = 0.001;
    for (int i = 1; i <= 10; ++i)
      scenario.floor.bumps.push_back({{0.36 * i, 0.0}, 0.5 * kPi, 1.5, 0.010, Under::left_wheel});
    Simulation simulation(scenario, 1);
    run_to_end(simulation, 300.0);
    ASSERT_TRUE(simulation.state().finished);
    lost_rad[corrected] =
        std::abs(simulation.state().estimated_pose.heading_rad - simulation.state().true_pose.heading_rad);
  }
  EXPECT_GT(lost_rad[0], 5.0 * extra_roll_m(0.075, 0.010) / 0.340);  // ten bumps and the systematic errors' part
  EXPECT_LT(lost_rad[1], lost_rad[0] / 5.0);
  RecordProperty("without_deg", std::to_string(degrees(lost_rad[0])));
  RecordProperty("with_deg", std::to_string(degrees(lost_rad[1])));
}

}  // namespace
}  // namespace odolab
