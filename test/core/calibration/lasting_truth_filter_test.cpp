#include "core/calibration/lasting_truth_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

constexpr double kWhite_m = 0.002, kFilteredOff_m = 0.005, kFilteredLasts_s = 1.5, kWhite_rad = 0.003;

// A vehicle that stands for a minute under an uneven clock.
InnovationRun standing(Random& random) {
  InnovationRun run;
  run.truth_has_heading = true;
  double time_s = 0.0, off_m[2] = {kFilteredOff_m * random.normal(), kFilteredOff_m * random.normal()};
  for (int i = 0; i < 200; ++i) {
    const double took_s = random.uniform(0.05, 0.5), decay = std::exp(-took_s / kFilteredLasts_s);
    time_s += took_s;
    for (double& off : off_m) off = decay * off + std::sqrt(1.0 - decay * decay) * kFilteredOff_m * random.normal();
    run.truth.push_back({time_s,
                         {off_m[0] + kWhite_m * random.normal(), off_m[1] + kWhite_m * random.normal()},
                         kWhite_rad * random.normal()});
  }
  run.wheels = {{0.0, 0.0, 0.0}, {time_s + 1.0, 0.0, 0.0}};
  run.set_aside.assign(run.truth.size(), 0);
  return run;
}

// -2 log L of what was read of a number of which nothing is known: of its differences.
double likelihood_of(const Eigen::VectorXd& read, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(read.size()), weighed = llt.solve(ones);
  const double information = ones.dot(weighed), mean = weighed.dot(read) / information;
  const Eigen::VectorXd left = read - mean * ones;
  return 2.0 * llt.matrixLLT().diagonal().array().log().sum() + std::log(information) + left.dot(llt.solve(left));
}

TEST(LastingTruthFilter, HasTheLikelihoodOfCorrelatedNoise) {
  Random random(5);
  const InnovationRun run = standing(random);
  const auto n = static_cast<Eigen::Index>(run.truth.size());
  Eigen::VectorXd x(n), y(n), heading(n);
  Eigen::MatrixXd lasting(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TruthSample& t = run.truth[static_cast<std::size_t>(i)];
    x(i) = t.position.x_m, y(i) = t.position.y_m, heading(i) = *t.heading_rad;
    for (Eigen::Index j = 0; j < n; ++j)
      lasting(i, j) = kFilteredOff_m * kFilteredOff_m *
                      std::exp(-std::abs(t.time_s - run.truth[static_cast<std::size_t>(j)].time_s) / kFilteredLasts_s);
  }
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const double expected = likelihood_of(x, lasting + kWhite_m * kWhite_m * one) +
                          likelihood_of(y, lasting + kWhite_m * kWhite_m * one) +
                          likelihood_of(heading, kWhite_rad * kWhite_rad * one);
  InnovationModel model;
  model.drive = {0.07, 0.07, 0.3};
  model.noise.truth_position_m = kWhite_m;
  model.noise.truth_heading_rad = kWhite_rad;
  model.noise.wander_m_per_sqrt_s = kFilteredOff_m * std::sqrt(2.0 / kFilteredLasts_s);
  model.noise.wander_lasts_s = kFilteredLasts_s;
  FilterOptions options;
  options.derivatives = false;
  const InnovationSums sums = filtered(run, summed_up(run, model), model, options);
  EXPECT_NEAR(sums.chi2 + sums.log_determinant, expected, 1e-6 * std::abs(expected));
}

}  // namespace
}  // namespace odolab
