#include "physics/benchmark.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace odolab {
namespace {

constexpr double kSide_m = 4.0, kSquareBase_m = 0.340, kSquareRadius_m = 0.075;

// The report's set-up: sonar corner of 2 mm and 0.4 degrees, and a floor rough enough for the spread it saw.
Scenario labmate_on_squares(double diameter_ratio, double wheelbase_ratio) {
  Scenario scenario;
  scenario.path = SquarePath{kSide_m, false};
  scenario.actual.wheelbase_m = kSquareBase_m * wheelbase_ratio;
  scenario.actual.wheel_radius_right_m = kSquareRadius_m * 2.0 * diameter_ratio / (diameter_ratio + 1.0);
  scenario.actual.wheel_radius_left_m = kSquareRadius_m * 2.0 / (diameter_ratio + 1.0);
  // An assumption that gives the report's spread of 25 mm. Its own simulation's bumps of 1 mm every 2 cm spread by 9 mm
  // here, and the report itself calls them "not very effective" (section 4.6.2).
  scenario.floor.roughness = {0.0022, 0.06};
  scenario.sensors.truth_period_s = 0.0;
  scenario.sensors.truth_position_noise_m = 0.002;
  scenario.sensors.truth_heading_noise_rad = radians(0.4);
  scenario.benchmark = Benchmark{};
  scenario.step_s = 0.002;  // half the time of 1 ms, and as true
  return scenario;
}

// Heading errors of a robot with these ratios: alpha by Eq. 6.28, beta from the arc that unequal wheels drive.
TypeErrors type_errors(double diameter_ratio, double wheelbase_ratio) {
  const double alpha = 0.5 * kPi * (1.0 - 1.0 / wheelbase_ratio);
  const double curvature = 2.0 * (diameter_ratio - 1.0) / ((diameter_ratio + 1.0) * kSquareBase_m);
  return {alpha, kSide_m * curvature};
}

// Eight robots that differ as those of Table III: 232 to 423 mm before calibration.
std::vector<Scenario> eight_labmates() {
  std::vector<Scenario> robots;
  Random random(2026);
  while (robots.size() < 8) {
    const double diameter_ratio = 1.0 + random.uniform(-0.003, 0.003);
    const double wheelbase_ratio = 1.0 + random.uniform(-0.01, 0.01);
    const TypeErrors e = type_errors(diameter_ratio, wheelbase_ratio);
    // The centre of gravity of the worse direction: x and y are both off by 2 L (|alpha| + |beta|), Eqs. 6.19, 6.20.
    const double largest_m = std::sqrt(2.0) * 2.0 * kSide_m * (std::abs(e.alpha_rad) + std::abs(e.beta_rad));
    if (largest_m > 0.232 && largest_m < 0.423) robots.push_back(labmate_on_squares(diameter_ratio, wheelbase_ratio));
  }
  return robots;
}

// Emax,syst after calibration is small against the scatter of its own measurement: five runs of 25 mm spread leave a
// standard error of 11 mm. It is therefore judged on forty squares; what five runs each way show is printed beside it.
TEST(UmbmarkBenchmark, CalibratesEightLabMatesTenfoldAsInTableThree) {
  double spread_sum = 0.0;
  std::uint64_t seed = 300;
  for (const Scenario& robot : eight_labmates()) {
    const std::vector<UmbmarkStage> stages = run_umbmark_calibration(robot, ++seed);
    ASSERT_GE(stages.size(), 2u);
    // The rule of section 6.3: a second compensation just where the first leaves more than 3 SEM.
    const UmbmarkMeasure& first = stages[1].measure;
    EXPECT_EQ(stages.size() == 3, first.largest_systematic_error_m > 3.0 * first.standard_error_m);

    Scenario calibrated = robot;
    calibrated.vehicle.kind = stages.back().nominal;
    calibrated.benchmark->runs_each_way = 20;
    const UmbmarkMeasure after = *measure_umbmark(run_umbmark(calibrated, seed + 1000));
    const double before_m = stages.front().measure.largest_systematic_error_m;
    EXPECT_GT(before_m / after.largest_systematic_error_m, 10.0);
    spread_sum += after.spread_m;
    std::printf(
        "  %.0f mm before; after %zu compensation(s) %.0f mm in five runs each way, %.0f mm in twenty: %.1f-fold\n",
        1e3 * before_m, stages.size() - 1, 1e3 * stages.back().measure.largest_systematic_error_m,
        1e3 * after.largest_systematic_error_m, before_m / after.largest_systematic_error_m);
  }
  EXPECT_NEAR(spread_sum / 8.0, 0.025, 0.005);  // "about 25 mm"
}

// Section 3.1: the two errors that cancel in one direction and add up in the other.
TEST(UmbmarkBenchmark, FindsBothErrorsWhereOneDirectionHidesThem) {
  const double wheelbase_ratio = 1.01;
  const double alpha = 0.5 * kPi * (1.0 - 1.0 / wheelbase_ratio);
  const double curvature =
      alpha / kSide_m;  // beta = alpha: hidden counter-clockwise, where x and y go with alpha - beta
  const double diameter_ratio = (1.0 + 0.5 * curvature * kSquareBase_m) / (1.0 - 0.5 * curvature * kSquareBase_m);
  Scenario robot = labmate_on_squares(diameter_ratio, wheelbase_ratio);
  robot.floor.roughness = {};
  const UmbmarkRuns runs = run_umbmark(robot, 7);
  const UmbmarkMeasure measure = *measure_umbmark(runs);
  EXPECT_LT(measure.counter_clockwise.distance_m, 0.010);                                   // nothing to see that way
  EXPECT_NEAR(measure.clockwise.distance_m, std::sqrt(2.0) * 4.0 * kSide_m * alpha, 0.02);  // 352 mm the other way
  const UmbmarkCalibration found = *calibrate_umbmark(runs, std::get<DifferentialDrive>(robot.vehicle.kind));
  EXPECT_NEAR(found.wheelbase_ratio, wheelbase_ratio, 3e-4);      // 2 mm of sonar over 8 L: 0.02 degrees in 90
  EXPECT_NEAR(found.wheel_diameter_ratio, diameter_ratio, 3e-5);  // the same angle over 4 m of side, times 340 mm
  EXPECT_NEAR(found.corrected.wheelbase_m, kSquareBase_m * wheelbase_ratio, 1e-4);
}

TEST(UmbmarkBenchmark, GivesTheSameRunsForAnyNumberOfThreadsAndStopsWhenTold) {
  Scenario robot = labmate_on_squares(1.001, 1.002);
  robot.path = SquarePath{0.5, false};
  robot.benchmark->runs_each_way = 2;
  std::vector<int> order;
  const UmbmarkRuns all = run_umbmark(
      robot, 3, [&](const BenchmarkRun& run) { order.push_back(run.clockwise ? run.number : -run.number); });
  EXPECT_EQ(order, (std::vector<int>{1, -1, 2, -2}));
  const UmbmarkRuns again = run_umbmark(robot, 3);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(all.clockwise[i].x_m, again.clockwise[i].x_m);
  // Told once the first run is done; it is asked before that too where a run takes long.
  const UmbmarkRuns stopped = run_umbmark(robot, 3, {}, [](double share_done) { return share_done == 0.0; });
  EXPECT_EQ(stopped.clockwise.size(), 1u);
  EXPECT_TRUE(stopped.counter_clockwise.empty());
}

}  // namespace
}  // namespace odolab
