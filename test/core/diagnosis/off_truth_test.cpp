#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/model/linearised.h"
#include "test/support/drive_generator.h"

namespace odolab::test {
namespace {

struct DrivenOffTruth {
  InnovationRun run;
  InnovationModel model;
};

// A minute, under a truth whose frame wanders and comes back within two seconds.
DrivenOffTruth driven_off_truth() {
  Random random(9);
  GeneratorSettings g;
  g.duration_s = 60.0;
  g.truth.axle_T_tracked = {0.06, -0.04, 0.1};
  DrivenOffTruth d;
  d.run = innovation_run(generated(g, rich_driving, random), Vehicle{}).value();
  d.run.set_aside[40] = 1;
  d.model.drive = g.drive;
  d.model.truth = g.truth;
  d.model.noise = {0.003, 0.001, 0.004, 0.0015, 0.0012, 0.001, 0.004, 0.003, 2.0};
  return d;
}

// What turns and carries the body for some seconds.
Motions some_motions(const InnovationRun& run) {
  Motions motions(run.wheels.size() - 1);
  for (std::size_t i = 100; i < 160; ++i)
    motions[i] = {1e-5 * std::sin(0.1 * static_cast<double>(i)), 2e-5, 3e-5 * std::cos(0.2 * static_cast<double>(i))};
  return motions;
}

TEST(LinearisedRun, CarriesAMotionAsTheFilterDoesWhereTheTruthsNoiseLasts) {
  DrivenOffTruth d = driven_off_truth();
  const LinearisedRun linear(d.run, d.model);
  const Motions motions = some_motions(d.run);
  std::vector<double> column(linear.residual().size(), 0.0);
  linear.of_motion(motions, column.data());
  ExtraColumn extra{"some", 1.0, {}};
  for (std::size_t i = 0; i + 1 < d.run.wheels.size(); ++i) extra.per_step.push_back(motions.at(i));
  d.run.extra = {extra};
  const LinearisedRun moved(d.run, d.model);
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const double by = linear.residual()[i] - moved.residual()[i];  // a prediction that is more leaves less
    difference += (by - column[i]) * (by - column[i]);
    size += column[i] * column[i];
  }
  EXPECT_GT(size, 0.01);
  // The whitener turns with the pose that is found: by a milliradian or two.
  EXPECT_LT(std::sqrt(difference / size), 0.01);
}

TEST(LinearisedRun, AsksTheOtherWayAboutForTheSameWhereTheTruthsNoiseLasts) {
  const DrivenOffTruth d = driven_off_truth();
  const LinearisedRun linear(d.run, d.model);
  const Motions motions = some_motions(d.run);
  std::vector<double> column(linear.residual().size(), 0.0);
  linear.of_motion(motions, column.data());
  double product = 0.0, square = 0.0, by_score = 0.0;
  for (std::size_t i = 0; i < column.size(); ++i)
    product += column[i] * linear.residual()[i], square += column[i] * column[i];
  const std::vector<BodyMotion> score = linear.score_of_motions(linear.residual().data());
  for (std::size_t i = 0; i < score.size(); ++i) {
    const BodyMotion m = motions.at(i);
    by_score += score[i].forward_m * m.forward_m + score[i].sideways_m * m.sideways_m + score[i].turn_rad * m.turn_rad;
  }
  EXPECT_NEAR(by_score, product, 1e-6 * std::sqrt(square));
  LinearisedRun::Moved moved;
  std::vector<double> products;
  linear.move({{motions}}, moved);
  linear.products_of(moved, linear.tails(), products);
  EXPECT_NEAR(products.at(0), square, 1e-5 * square);
}

TEST(LinearisedRun, CarriesItsParametersAsTheFilterDoesWhereTheTruthsNoiseLasts) {
  DrivenOffTruth d = driven_off_truth();
  const LinearisedRun linear(d.run, d.model);
  const std::size_t rows = linear.residual().size();
  std::vector<std::vector<double>> of(column::first_extra, std::vector<double>(rows, 0.0));
  std::array<double*, column::first_extra> out{};
  for (std::size_t k = 0; k < of.size(); ++k) out[k] = of[k].data();
  linear.of_parameters(out);
  const auto differs = [&](int which, double by, const InnovationModel& more) {
    const LinearisedRun moved(d.run, more);
    double difference = 0.0, size = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
      const double now = (linear.residual()[i] - moved.residual()[i]) / by,
                   then = of[static_cast<std::size_t>(which)][i];
      difference += (now - then) * (now - then);
      size += then * then;
    }
    return std::sqrt(difference / size);
  };
  InnovationModel more = d.model;
  more.drive.wheel_radius_left_m += 1e-6;
  EXPECT_LT(differs(column::wheel_radius_left, 1e-6, more), 0.02);
  more = d.model;
  more.truth.axle_T_tracked.y_m += 1e-6;
  EXPECT_LT(differs(column::mounting_y, 1e-6, more), 0.02);
  more = d.model;
  more.truth.axle_T_tracked.heading_rad += 1e-6;
  EXPECT_LT(differs(column::mounting_heading, 1e-6, more), 0.02);
}

}  // namespace
}  // namespace odolab::test
