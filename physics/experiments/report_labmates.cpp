#include "physics/experiments/report_labmates.h"

#include <cmath>

#include "core/base/random.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

constexpr double kLeastBefore_m = 0.232, kMostBefore_m = 0.423;  // Table III

}  // namespace

Scenario on_report_squares() {
  Scenario scenario;
  scenario.path = SquarePath{kReportSide_m, false};
  scenario.floor.roughness = report_floor();
  scenario.sensors.truth_period_s = 0.0;
  scenario.sensors.truth_position_noise_m = 0.002;
  scenario.sensors.truth_heading_noise_rad = radians(0.4);
  scenario.benchmark = Benchmark{};
  scenario.step_s = 0.002;  // half the time of 1 ms, and as true
  return scenario;
}

Roughness report_floor() { return {0.0022, 0.06}; }

double travelled_per_rolled_on_report_floor() {
  constexpr double kWay_m = 100.0;
  Scenario robot = on_report_squares();
  robot.path = StraightPath{kWay_m, false};
  Simulation simulation(robot, 1);
  run_to_end(simulation, 2000.0);
  return length(between(robot.start, simulation.state().true_pose).position()) / kWay_m;
}

std::string report_floor_assumption() {
  return "the floor: bumps of random height up to 2.2 mm every 6 cm under each wheel, which scatter a LabMate by the "
         "25 mm of section 6.3 (the report gives the scatter, not the floor)";
}

Scenario labmate_on_report_squares(double diameter_ratio, double wheelbase_ratio) {
  Scenario scenario = on_report_squares();
  scenario.actual = as_drawn(std::get<DifferentialDrive>(scenario.vehicle.kind));
  scenario.actual.wheelbase_m *= wheelbase_ratio;
  scenario.actual.wheel_radius_right_m *= 2.0 * diameter_ratio / (diameter_ratio + 1.0);
  scenario.actual.wheel_radius_left_m *= 2.0 / (diameter_ratio + 1.0);
  return scenario;
}

TypeErrors type_errors(double diameter_ratio, double wheelbase_ratio, double nominal_wheelbase_m) {
  const double alpha = 0.5 * kPi * (1.0 - 1.0 / wheelbase_ratio);
  const double curvature =
      2.0 * (diameter_ratio - 1.0) / ((diameter_ratio + 1.0) * nominal_wheelbase_m * wheelbase_ratio);
  return {alpha, kReportSide_m * curvature};
}

double first_order_largest_error_m(const TypeErrors& e, double side_m) {
  return std::sqrt(2.0) * 2.0 * side_m * (std::abs(e.alpha_rad) + std::abs(e.beta_rad));
}

std::vector<Scenario> labmates_of_table3(int count, std::uint64_t seed) {
  std::vector<Scenario> robots;
  Random random(seed);
  while (static_cast<int>(robots.size()) < count) {
    const double diameter_ratio = 1.0 + random.uniform(-0.003, 0.003);
    const double wheelbase_ratio = 1.0 + random.uniform(-0.01, 0.01);
    const double largest_m = first_order_largest_error_m(type_errors(diameter_ratio, wheelbase_ratio));
    if (largest_m > kLeastBefore_m && largest_m < kMostBefore_m)
      robots.push_back(labmate_on_report_squares(diameter_ratio, wheelbase_ratio));
  }
  return robots;
}

}  // namespace odolab
