#include "core/calibration/correlated_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/calibration/least_squares.h"
#include "test/support/known_drive.h"
#include "test/support/missing_physics.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

// As a tracker does that hands on the mean of so many samples; the stamp is that of the middle one.
Recording with_smoothed_truth(Recording r, int samples) {
  std::vector<std::size_t> rows;
  const Channel* x = r.channel("truth_x_m");
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    if (!std::isnan(x->values[i])) rows.push_back(i);
  for (Channel& channel : r.channels) {
    if (channel.name.rfind("truth_", 0) != 0) continue;
    std::vector<double> whole = channel.values;  // headings are smoothed on their way, not around the circle
    if (channel.name == "truth_heading_rad")
      for (std::size_t k = 1; k < rows.size(); ++k)
        whole[rows[k]] = whole[rows[k - 1]] + wrapped(channel.values[rows[k]] - channel.values[rows[k - 1]]);
    const int half = samples / 2, n = static_cast<int>(rows.size());
    for (int k = half; k + half < n; ++k) {
      double sum = 0.0;
      for (int j = -half; j <= half; ++j) sum += whole[rows[static_cast<std::size_t>(k + j)]];
      channel.values[rows[static_cast<std::size_t>(k)]] = sum / (2 * half + 1);
    }
  }
  return r;
}

Case correlated_case() {
  CaseSettings c;
  c.runs = 3;
  c.duration_s = 40.0;
  return generated_case(c, 7301);
}

TEST(CorrelatedTruth, KeepsSamplesThatAreSoFarApartAndAllThatIsNotTruth) {
  const Recording whole = correlated_case().recordings[0], fewer = with_truth_apart(whole, 0.1);
  double last_s = -1.0;
  for (std::size_t i = 0; i < fewer.time_s.size(); ++i) {
    EXPECT_EQ(std::isnan(fewer.channel("truth_x_m")->values[i]),
              std::isnan(fewer.channel("truth_heading_rad")->values[i]));
    if (std::isnan(fewer.channel("truth_x_m")->values[i])) continue;
    EXPECT_GE(fewer.time_s[i] - last_s, 0.1 - 1e-9);
    last_s = fewer.time_s[i];
  }
  EXPECT_GT(last_s, whole.time_s.back() - 0.2);
  const std::vector<double>&a = whole.channel("left_wheel_rad")->values, &b = fewer.channel("left_wheel_rad")->values;
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])));
}

// A scanner of ten poses a second: each second one is kept, or each third, by when the log began.
TEST(CorrelatedTruth, KeepsTheSameSamplesWheneverTheLogBegan) {
  for (const double begins_s : {0.0, 2.05, 50.006, 1000.03, 1.7e9}) {
    Recording r;
    for (int i = 0; i < 600; ++i) r.time_s.push_back(std::round(1e3 * (begins_s + 0.1 * i)) / 1e3);
    r.add_channel("truth_x_m").values.assign(r.time_s.size(), 1.0);
    for (const double apart_s : {0.2, 0.3, 0.5, 1.0}) {
      const Recording fewer = with_truth_apart(r, apart_s);
      const std::vector<double>& x_m = fewer.channel("truth_x_m")->values;
      EXPECT_EQ(std::count(x_m.begin(), x_m.end(), 1.0), std::lround(60.0 / apart_s)) << begins_s << ", " << apart_s;
    }
  }
}

TEST(CorrelatedTruth, OfATrackerThatSmoothsBendsNoCalibration) {
  Case c = correlated_case();
  for (Recording& r : c.recordings) r = with_smoothed_truth(std::move(r), 9);
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->truth_apart_s, 0.0) << fit->lasting_correlation;
  expect_holds(*fit, c.actual);
}

TEST(CorrelatedTruth, IsNotSuspectedWhereTheNoiseIsWhite) {
  const Case c = correlated_case();
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->truth_apart_s, 0.0);
}

// Stands for three seconds, drives for two, ten times over; the truth's noise lasts from sample to sample by so much.
Recording stop_and_go(double lasts, std::uint64_t seed) {
  Random random(seed);
  Recording r;
  std::vector<double> wheel, x, heading;
  double noise_m = 0.0, noise_rad = 0.0, rolled_rad = 0.0;
  for (int i = 0; i < 500; ++i) {  // ten a second
    r.time_s.push_back(0.1 * i);
    if (i % 50 >= 30) rolled_rad += 0.5;
    wheel.push_back(rolled_rad);
    const double fresh = std::sqrt(1.0 - lasts * lasts);
    noise_m = lasts * noise_m + 0.01 * fresh * random.normal();
    noise_rad = lasts * noise_rad + 0.01 * fresh * random.normal();
    x.push_back(0.075 * rolled_rad + noise_m);
    heading.push_back(wrapped(3.14 + noise_rad));
  }
  r.add_channel("left_wheel_rad").values = wheel;
  r.add_channel("right_wheel_rad").values = wheel;
  r.add_channel("truth_x_m").values = x;
  r.add_channel("truth_y_m").values = x;
  r.add_channel("truth_heading_rad").values = heading;
  return r;
}

TEST(CorrelatedTruth, IsToldAtRest) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto white = correlation_at_rest({stop_and_go(0.0, seed)}, DifferentialDrive{});
    const auto smoothed = correlation_at_rest({stop_and_go(0.8, seed)}, DifferentialDrive{});
    ASSERT_TRUE(white && smoothed);
    // Some 200 samples in rests of twenty: a standard error of 0.07, of which the larger of two channels is taken.
    EXPECT_LT(*white, 0.25) << seed;
    EXPECT_GT(*smoothed, 0.45) << seed;
  }
}

TEST(CorrelatedTruth, IsToldByTheRestWithWhichRecordingsBegin) {
  std::vector<Recording> beginnings;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Recording r = stop_and_go(0.8, seed);
    constexpr std::size_t kRows = 9;  // 0.9 s
    r.time_s.resize(kRows);
    for (Channel& c : r.channels) c.values.resize(kRows);
    beginnings.push_back(std::move(r));
  }
  const auto smoothed = correlation_at_rest(beginnings, DifferentialDrive{});
  ASSERT_TRUE(smoothed);
  // Nine samples tell less of what lasts than twenty: their mean takes a part of it.
  EXPECT_GT(*smoothed, 0.3);
}

TEST(CorrelatedTruth, IsNotToldWhereNothingRests) {
  Recording r = stop_and_go(0.0, 1);
  for (Channel& c : r.channels)
    if (c.name == "left_wheel_rad")
      for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] += 0.01 * static_cast<double>(i);
  EXPECT_FALSE(correlation_at_rest({r}, DifferentialDrive{}));
}

TEST(CorrelatedTruth, RestsWhereTheWheelsDoByWhateverClock) {
  constexpr double kLate_s = 6.0;
  const Recording r = stop_and_go(0.8, 3);
  const auto own = correlation_at_rest({r}, DifferentialDrive{}),
             late = correlation_at_rest({test::with_truths_clock(r, kLate_s, 0.0)}, DifferentialDrive{}, kLate_s);
  ASSERT_TRUE(own && late);
  EXPECT_NEAR(*late, *own, 0.02);  // by rounding a sample more or less at the end of a rest
}

}  // namespace
}  // namespace odolab::test
