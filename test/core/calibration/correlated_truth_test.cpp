#include "core/calibration/correlated_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/calibration/least_squares.h"
#include "test/support/known_drive.h"
#include "test/support/missing_physics.h"

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

Case a_case() {
  CaseSettings c;
  c.runs = 3;
  c.duration_s = 40.0;
  return generated_case(c, 7301);
}

TEST(CorrelatedTruth, KeepsSamplesThatAreSoFarApartAndAllThatIsNotTruth) {
  const Recording whole = a_case().recordings[0], fewer = with_truth_apart(whole, 0.1);
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

TEST(CorrelatedTruth, OfATrackerThatSmoothsBendsNoCalibration) {
  Case c = a_case();
  for (Recording& r : c.recordings) r = with_smoothed_truth(std::move(r), 9);
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->truth_apart_s, 0.0) << fit->lasting_correlation;
  expect_holds(*fit, c.actual);
}

TEST(CorrelatedTruth, IsNotSuspectedWhereTheNoiseIsWhite) {
  const Case c = a_case();
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->truth_apart_s, 0.0);
}

}  // namespace
}  // namespace odolab::test
