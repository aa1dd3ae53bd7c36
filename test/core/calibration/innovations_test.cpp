#include "core/calibration/innovations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/calibration/left_out.h"
#include "test/support/drive_generator.h"

namespace odolab {
namespace {

InnovationModel model_off_nominal() {
  InnovationModel m;
  m.drive.wheel_radius_right_m = 0.0757;
  m.truth.axle_T_tracked = {0.06, -0.04, 0.1};
  m.truth.time_offset_s = 0.0123;  // no truth falls on a wheel sample: there the clock's derivative has a kink
  m.noise = {0.003, 0.001, 0.004};
  return m;
}

double& model_parameter(InnovationModel& m, InnovationRun& run, int c) {
  switch (c) {
    case column::wheel_radius_left:
      return m.drive.wheel_radius_left_m;
    case column::wheel_radius_right:
      return m.drive.wheel_radius_right_m;
    case column::wheelbase:
      return m.drive.wheelbase_m;
    case column::mounting_x:
      return m.truth.axle_T_tracked.x_m;
    case column::mounting_y:
      return m.truth.axle_T_tracked.y_m;
    case column::mounting_heading:
      return m.truth.axle_T_tracked.heading_rad;
    case column::truth_clock:
      return m.truth.time_offset_s;
    default:
      return run.extra[static_cast<std::size_t>(c - column::first_extra)].value;
  }
}

// A run with two extra columns: a sideways crawl per metre, and a heading drift per second.
InnovationRun a_run(double truth_period_s) {
  Random random(3);
  test::GeneratorSettings g;
  g.duration_s = 18.0;
  g.truth_period_s = truth_period_s;
  g.drive = model_off_nominal().drive;
  g.truth = model_off_nominal().truth;
  g.wheel_noise = 0.003;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.004;
  InnovationRun run = innovation_run(generated(g, test::rich_driving, random), Vehicle{}).value();
  cut_where_left_out(run, model_off_nominal().truth.time_offset_s);
  run.smooth.clear();  // derivatives by the readings themselves are what differences give
  ExtraColumn crawl{"sideways_per_metre", 2e-4, {}}, drift{"turn_per_second", -1e-4, {}};
  for (const DriveStep& s : drive_steps(run, DifferentialDrive{})) {
    crawl.per_step.push_back({0.0, 0.5 * (s.left_m + s.right_m), 0.0});
    drift.per_step.push_back({0.0, 0.0, s.duration_s});
  }
  run.extra = {crawl, drift};
  return run;
}

std::vector<Innovation> innovations_of(const InnovationRun& run, const InnovationModel& m) {
  std::vector<Innovation> all;
  FilterOptions options;
  options.derivatives = false;
  options.on_innovation = [&](const Innovation& i) { all.push_back(i); };
  filtered(run, summed_up(run, m), m, options);
  return all;
}

TEST(Innovations, DerivativesOfTheMotionAgreeWithDifferences) {
  InnovationRun run = a_run(0.7);
  InnovationModel m = model_off_nominal();
  const SummedRun summed = summed_up(run, m);
  for (int c = 0; c < summed.columns; ++c) {
    if (c >= column::mounting_x && c <= column::mounting_heading) continue;  // the motion does not know them
    const double h = 1e-6;
    model_parameter(m, run, c) += h;
    const SummedRun above = summed_up(run, m);
    model_parameter(m, run, c) -= 2 * h;
    const SummedRun below = summed_up(run, m);
    model_parameter(m, run, c) += h;
    for (std::size_t i = 0; i < summed.motions.size(); ++i) {
      const Pose &a = above.motions[i].motion, &b = below.motions[i].motion;
      const double* d =
          &summed.derivatives[3 * (i * static_cast<std::size_t>(summed.columns) + static_cast<std::size_t>(c))];
      // Central differences: h^2 times third derivatives of order 1/r^2 = 200, and rounding 1e-16 / h. The clock's
      // takes the end of an interval to move along the tangent and not along the chord: square of the turn in 20 ms,
      // 4e-4, times v, less than 0.5 m/s; a quarter of it where the speed is even, more where it changes on the way.
      const double tolerance = c == column::truth_clock ? 4e-4 * 0.5 / 4.0 : 1e-7;
      EXPECT_NEAR(d[0], (a.x_m - b.x_m) / (2 * h), tolerance * (1 + std::abs(d[0]))) << c << " " << i;
      EXPECT_NEAR(d[1], (a.y_m - b.y_m) / (2 * h), tolerance * (1 + std::abs(d[1]))) << c << " " << i;
      EXPECT_NEAR(d[2], (a.heading_rad - b.heading_rad) / (2 * h), tolerance * (1 + std::abs(d[2]))) << c << " " << i;
    }
  }
}

TEST(Innovations, InformationOfOneMeasurementAgreesWithDifferences) {
  InnovationRun run = a_run(0.0);  // start and end only: one innovation, whose derivative is exact
  ASSERT_EQ(run.truth.size(), 2u);
  InnovationModel m = model_off_nominal();
  const int p = column::first_extra + 2;
  const InnovationSums sums = filtered(run, summed_up(run, m), m);
  const Innovation at = innovations_of(run, m).at(0);
  std::vector<std::array<double, 3>> j(static_cast<std::size_t>(p));
  for (int c = 0; c < p; ++c) {
    const double h = 1e-6;
    model_parameter(m, run, c) += h;
    const Innovation above = innovations_of(run, m).at(0);
    model_parameter(m, run, c) -= 2 * h;
    const Innovation below = innovations_of(run, m).at(0);
    model_parameter(m, run, c) += h;
    for (int k = 0; k < 3; ++k) j[c][k] = -(above.residual[k] - below.residual[k]) / (2 * h);
  }
  // Whitened by the covariance at hand.
  const double* s = at.covariance;
  const double l00 = std::sqrt(s[0]), l10 = s[1] / l00, l20 = s[2] / l00, l11 = std::sqrt(s[3] - l10 * l10);
  const double l21 = (s[4] - l20 * l10) / l11, l22 = std::sqrt(s[5] - l20 * l20 - l21 * l21);
  for (auto& v : j) {
    v[0] /= l00;
    v[1] = (v[1] - l10 * v[0]) / l11;
    v[2] = (v[2] - l20 * v[0] - l21 * v[1]) / l22;
  }
  for (int r = 0; r < p; ++r) {
    double score = 0.0;
    for (int k = 0; k < 3; ++k) score += j[r][k] * at.white[k];
    EXPECT_NEAR(sums.score[r], score, 1e-5 * (1 + std::abs(score)));
    for (int c = 0; c < p; ++c) {
      const double expected = j[r][0] * j[c][0] + j[r][1] * j[c][1] + j[r][2] * j[c][2];
      EXPECT_NEAR(sums.information[r * p + c], expected,
                  1e-5 * (std::abs(expected) + std::sqrt(sums.information[r * p + r] * sums.information[c * p + c])))
          << r << c;
    }
  }
}

TEST(Innovations, DerivativesPassThroughTheGain) {
  InnovationRun run = a_run(0.3);
  InnovationModel m = model_off_nominal();
  const int p = column::first_extra + 2;
  const InnovationSums sums = filtered(run, summed_up(run, m), m);
  const std::vector<Innovation> at = innovations_of(run, m);
  for (int c = 0; c < p; ++c) {
    const double h = 1e-6;
    model_parameter(m, run, c) += h;
    const std::vector<Innovation> above = innovations_of(run, m);
    model_parameter(m, run, c) -= 2 * h;
    const std::vector<Innovation> below = innovations_of(run, m);
    model_parameter(m, run, c) += h;
    // Squared length of the whitened derivative: the information's diagonal. The differences also contain the change of
    // the gain and of the whitening, which the filter holds fixed: a share of the order of the residual over the
    // leverage.
    double squares = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (int k = 0; k < 3; ++k) squares += std::pow((above[i].white[k] - below[i].white[k]) / (2 * h), 2);
    EXPECT_NEAR(sums.information[c * p + c], squares, 0.02 * squares) << c;
  }
}

TEST(Innovations, AreWhiteAndOfSizeOneUnderTheTrueModel) {
  double squares = 0.0, products = 0.0;
  int n = 0;
  for (int i = 0; i < 10; ++i) {
    Random random(seed_of_stream(5, i));
    test::GeneratorSettings g;
    g.duration_s = 30.0;
    g.wheel_noise = 0.004;
    g.truth_position_noise_m = 0.0005;
    g.truth_heading_noise_rad = 0.002;
    const InnovationRun run = innovation_run(generated(g, test::rich_driving, random), Vehicle{}).value();
    InnovationModel m;
    m.noise = {0.004, 0.0005, 0.002};
    const std::vector<Innovation> all = innovations_of(run, m);
    for (std::size_t k = 0; k < all.size(); ++k)
      for (int c = 0; c < 3; ++c, ++n) {
        squares += all[k].white[c] * all[k].white[c];
        if (k > 0) products += all[k].white[c] * all[k - 1].white[c];
      }
  }
  // 18 000 numbers: a mean square scatters by sqrt(2 / n) = 1.1 %, a correlation by 0.7 %; four of them, and 3 % more
  // for the model of rounding as white.
  EXPECT_NEAR(squares / n, 1.0, 0.07);
  EXPECT_NEAR(products / n, 0.0, 0.04);
}

TEST(Innovations, BatchScoresAddUpToTheScore) {
  const InnovationRun run = a_run(0.1);
  const InnovationModel m = model_off_nominal();
  FilterOptions options;
  options.batch = 7;
  const InnovationSums sums = filtered(run, summed_up(run, m), m, options);
  for (std::size_t c = 0; c < sums.score.size(); ++c) {
    double total = 0.0;
    for (const std::vector<double>& g : sums.batch_scores) total += g[c];
    EXPECT_NEAR(total, sums.score[c], 1e-9 * (1 + std::abs(sums.score[c])));
  }
}

TEST(Innovations, SeesWhetherRotationsAreWholeCounts) {
  Random random(1);
  test::GeneratorSettings g;
  g.duration_s = 5.0;
  EXPECT_TRUE(innovation_run(generated(g, test::rich_driving, random), Vehicle{})->counts_show);
  g.counts = false;
  EXPECT_FALSE(innovation_run(generated(g, test::rich_driving, random), Vehicle{})->counts_show);
}

TEST(Innovations, LeaveTruthOutsideTheWheelsTimeOut) {
  Recording r;
  r.time_s = {0.0, 1.0, 2.0, 3.0, 9.0};
  const double nan = std::nan("");
  r.channels = {{"left_wheel_rad", {0.0, 1.0, 2.0, 3.0, nan}},
                {"right_wheel_rad", {0.0, 1.0, 2.0, 3.0, nan}},
                {"truth_x_m", {0.0, nan, nan, 0.2, 9.0}},
                {"truth_y_m", {0.0, nan, nan, 0.0, 9.0}}};
  const auto run = innovation_run(r, Vehicle{});
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run->truth.size(), 2u);
  EXPECT_FALSE(run->truth_has_heading);
}

// A hundred readings at 50 Hz of wheels that turn alike, with a pose as they begin and one 0.32 s behind the last.
Recording with_a_late_end(const std::function<double(int reading)>& turned_rad) {
  const double nan = std::nan("");
  Recording r;
  Channel left{"left_wheel_rad", {}}, x{"truth_x_m", {}}, y{"truth_y_m", {}};
  for (int i = 0; i < 100; ++i) {
    r.time_s.push_back(0.02 * i);
    left.values.push_back(turned_rad(i));
    x.values.push_back(i == 0 ? 0.0 : nan);
    y.values.push_back(i == 0 ? 0.0 : nan);
  }
  r.time_s.push_back(2.3);
  left.values.push_back(nan);
  x.values.push_back(7.0);
  y.values.push_back(0.0);
  r.channels = {left, {"right_wheel_rad", left.values}, x, y};
  return r;
}

TEST(Innovations, KeepAPoseAtTheEndThatIsStampedALittleLaterThanTheWheelsThatStandThere) {
  for (const bool stands : {true, false}) {
    const Recording r = with_a_late_end([&](int i) { return stands ? std::min(i, 98) : i; });
    EXPECT_EQ(innovation_run(r, Vehicle{}).ok(), stands) << "where it drives on nobody knows how far";
  }
}

TEST(Innovations, KeepSuchAPoseWhereWheelsHardlyMovedUntilThen) {
  const Vehicle vehicle;
  const auto drive = std::get<DifferentialDrive>(vehicle.kind);
  const double count_rad = 2.0 * kPi / drive.counts_per_wheel_turn();
  for (const double speed_mps : {0.0, 0.002, 0.02}) {
    const Recording r = with_a_late_end([&](int i) {
      const double creeps_rad = 0.02 * std::max(0, i - 70) * speed_mps / drive.wheel_radius_left_m;
      return 0.1 * std::min(i, 70) - creeps_rad - (i == 99 ? count_rad : 0.0);  // read a count less at last
    });
    EXPECT_EQ(innovation_run(r, vehicle).ok(), speed_mps * 0.32 < 0.001) << speed_mps << " m/s";
  }
}

std::vector<char> aside_by_gate(const InnovationRun& run) {
  FilterOptions options;
  options.derivatives = false;
  options.gate = kGate;
  const InnovationModel m = model_off_nominal();
  return filtered(run, summed_up(run, m), m, options).set_aside;
}

TEST(Innovations, GateSetsAnOutlierAsideWithWhichARunBegins) {
  InnovationRun run = a_run(0.05);
  const std::vector<char> sound = aside_by_gate(run);
  EXPECT_EQ(std::count(sound.begin(), sound.begin() + 10, 1), 0);
  run.truth[0].position.x_m += 0.2;
  const std::vector<char> aside = aside_by_gate(run);
  EXPECT_EQ(aside[0], 1);
  EXPECT_EQ(std::count(aside.begin() + 1, aside.begin() + 10, 1), 0);
}

TEST(Innovations, GateLeavesPosesAtBothEndsOfARunAlone) {
  InnovationRun run = a_run(0.0);
  ASSERT_LT(run.truth.size(), 5u);
  run.truth.back().position.x_m += 1.0;
  EXPECT_EQ(aside_by_gate(run).back(), 0);
}

// Five poses at rest at either end agree with each other on what the wheels missed on the way.
TEST(Innovations, GateLeavesSeveralPosesAtEitherEndAlone) {
  constexpr std::ptrdiff_t kAtEither = 5;
  InnovationRun run = a_run(0.05);
  run.truth.erase(run.truth.begin() + kAtEither, run.truth.end() - kAtEither);
  run.set_aside.assign(run.truth.size(), 0);
  for (std::size_t k = kAtEither; k < run.truth.size(); ++k) run.truth[k].position.x_m += 1.0;
  const std::vector<char> aside = aside_by_gate(run);
  EXPECT_EQ(std::count(aside.begin(), aside.end(), 0), 2 * kAtEither);
}

}  // namespace
}  // namespace odolab
