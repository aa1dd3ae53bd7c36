#include "physics/experiments/concealed/drawn_robot.h"

#include <algorithm>
#include <cmath>

#include "physics/ground.h"

namespace odolab::concealed {

namespace {

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

int index_below(Random& random, int count) {
  return std::min(count - 1, static_cast<int>(random.uniform() * static_cast<double>(count)));
}

// Standard deviation of what a wheel loses on bumps of even-drawn height, per root metre.
double roughness_noise(const Roughness& roughness, double radius_m) {
  if (roughness.largest_height_m <= 0.0) return 0.0;
  constexpr int kHeights = 200;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kHeights; ++i) {
    const double extra = extra_roll_m(radius_m, roughness.largest_height_m * (i + 0.5) / kHeights);
    sum += extra / kHeights;
    squares += extra * extra / kHeights;
  }
  return std::sqrt((squares - sum * sum) / roughness.spacing_m);
}

}  // namespace

DifferentialDrive DrawnRobot::actual() const {
  DifferentialDrive drive = nominal();
  drive.wheel_radius_left_m = scenario.actual.wheel_radius_left_m;
  drive.wheel_radius_right_m = scenario.actual.wheel_radius_right_m;
  drive.wheelbase_m = scenario.actual.wheelbase_m;
  return drive;
}

double DrawnRobot::wheel_noise_m_per_sqrt_m() const {
  return std::hypot(rolling_noise_m_per_sqrt_m,
                    roughness_noise(scenario.floor.roughness, scenario.actual.wheel_radius_left_m));
}

DrawnRobot drawn_robot(Random& random, bool smooth) {
  DrawnRobot robot;
  Scenario& s = robot.scenario;
  DifferentialDrive built;
  const double radius_m = random.uniform(0.06, 0.09);
  built.wheel_radius_left_m = radius_m * random.uniform(0.998, 1.002);
  built.wheel_radius_right_m = radius_m * random.uniform(0.998, 1.002);
  built.wheelbase_m = random.uniform(0.28, 0.45);
  s.actual = as_drawn(built);
  const double weight = random.uniform(0.7, 1.3);
  s.actual.mass_kg *= weight;
  s.actual.moment_of_inertia_kgm2 *= weight;

  DifferentialDrive nominal = built;
  nominal.wheel_radius_left_m *= random.uniform(0.98, 1.02);
  nominal.wheel_radius_right_m *= random.uniform(0.98, 1.02);
  nominal.wheelbase_m *= random.uniform(0.96, 1.04);
  constexpr double kCounts[] = {1000.0, 2000.0, 4096.0, 16384.0};
  nominal.encoder_counts_per_revolution = kCounts[index_below(random, 4)];
  s.vehicle.name = "drawn robot";
  s.vehicle.kind = nominal;
  s.vehicle.truth.axle_T_tracked = {random.uniform(-0.1, 0.1), random.uniform(-0.05, 0.05), 0.0};

  s.floor.friction = random.uniform(0.6, 0.9);
  const double height_m = random.uniform(0.0, 0.001);
  if (!smooth && random.uniform() < 0.5) s.floor.roughness.largest_height_m = height_m;
  robot.rolling_noise_m_per_sqrt_m = log_uniform(random, 2e-4, 2e-3);

  constexpr double kEncoder_s[] = {0.010, 0.020, 0.025};
  constexpr double kTruth_s[] = {0.005, 0.008, 0.010, 0.016, 0.020};
  s.sensors.encoder_period_s = kEncoder_s[index_below(random, 3)];
  s.sensors.truth_period_s = kTruth_s[index_below(random, 5)];
  s.sensors.truth_position_noise_m = log_uniform(random, 3e-4, 3e-3);
  s.sensors.truth_heading_noise_rad = log_uniform(random, 5e-4, 3e-3);
  robot.stamp_jitter_s = random.uniform(0.0, 3e-4);
  return robot;
}

}  // namespace odolab::concealed
