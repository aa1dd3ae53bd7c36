#include "core/diagnosis/quality/drawn_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

// Ten times a second, a straight of 10 s and then a circle of a metre, at 0.5 m/s; off by noise of so much.
std::vector<TruthSample> straight_then_circle(double noise_m) {
  Random random(31);
  std::vector<TruthSample> truth;
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i, turned = std::max(0.0, 0.5 * (t - 10.0));
    TruthSample s;
    s.time_s = t;
    s.position = t < 10.0 ? Vec2{0.5 * t, 0.0} : Vec2{5.0 + std::sin(turned), 1.0 - std::cos(turned)};
    s.position.x_m += noise_m * random.normal();
    s.position.y_m += noise_m * random.normal();
    s.heading_rad = turned + noise_m * random.normal();
    truth.push_back(s);
  }
  return truth;
}

void draw_a_line(std::vector<TruthSample>& truth, std::size_t from, std::size_t to) {
  for (std::size_t i = from + 1; i < to; ++i) {
    const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
    truth[i].position = truth[from].position + share * (truth[to].position - truth[from].position);
    truth[i].heading_rad = *truth[from].heading_rad + share * (*truth[to].heading_rad - *truth[from].heading_rad);
  }
}

TEST(DrawnTruth, IsFoundWhereGapsWereFilledWithStraightLines) {
  std::vector<TruthSample> truth = straight_then_circle(0.005);
  draw_a_line(truth, 200, 206);
  draw_a_line(truth, 410, 425);
  const TimeStretches drawn = drawn_truth(truth);
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(drawn[0].first, truth[200].time_s);
  EXPECT_EQ(drawn[0].second, truth[206].time_s);
  EXPECT_EQ(drawn[1].first, truth[410].time_s);
  EXPECT_EQ(drawn[1].second, truth[425].time_s);
}

// Nearly round the circle in twelve seconds: the line goes a fifteenth of the way, slower than the truth trembles.
TEST(DrawnTruth, IsFoundWhereItsLineIsSlowAndLong) {
  std::vector<TruthSample> truth = straight_then_circle(0.005);
  draw_a_line(truth, 200, 318);
  const TimeStretches drawn = drawn_truth(truth);
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_EQ(drawn[0].first, truth[200].time_s);
  EXPECT_EQ(drawn[0].second, truth[318].time_s);
}

// A tracker that holds what hardly changes.
TEST(DrawnTruth, IsNotFoundWhereAVehicleRests) {
  std::vector<TruthSample> truth = straight_then_circle(0.005);
  for (std::size_t i = 201; i < 300; ++i)
    truth[i].position = truth[200].position, truth[i].heading_rad = truth[200].heading_rad;
  EXPECT_TRUE(drawn_truth(truth).empty());
}

TEST(DrawnTruth, IsNotFoundInNoise) { EXPECT_TRUE(drawn_truth(straight_then_circle(0.005)).empty()); }

TEST(DrawnTruth, IsNotFoundWhereAVehicleDrivesStraightWithoutNoise) {
  EXPECT_TRUE(drawn_truth(straight_then_circle(0.0)).empty());
}

// Smooth by itself, and written with three decimals.
TEST(DrawnTruth, IsNotFoundWhereATruthIsRoundedToWhatItTremblesBy) {
  std::vector<TruthSample> truth;
  for (int k = 0; k < 2000; ++k) {
    const double along_m = 0.004 * k + 0.02 * std::sin(0.01 * k);
    const auto rounded = [](double m) { return 0.001 * std::round(1000.0 * m); };
    truth.push_back({0.01 * k, {rounded(along_m), rounded(0.1 * std::sin(along_m))}, 0.0});
  }
  EXPECT_TRUE(drawn_truth(truth).empty());
}

}  // namespace
}  // namespace odolab
