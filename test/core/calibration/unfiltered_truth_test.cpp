#include "core/calibration/unfiltered_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "test/support/drive_generator.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

using test::GeneratorSettings;

// A radio's poses without headings, ten a second, 30 mm off.
GeneratorSettings by_radio() {
  GeneratorSettings g;
  g.drive.wheel_radius_left_m = 0.075 * 1.004;
  g.drive.wheel_radius_right_m = 0.075 * 0.997;
  g.drive.wheelbase_m = 0.340 * 1.01;
  g.wheel_noise = 0.001;
  g.truth_period_s = 0.1;
  g.truth_position_noise_m = 0.03;
  g.duration_s = 120.0;
  return g;
}

std::vector<double*> truth_of(Recording& recording, const char* channel) {
  std::vector<double*> samples;
  for (Channel& c : recording.channels)
    if (c.name == channel)
      for (double& v : c.values)
        if (!std::isnan(v)) samples.push_back(&v);
  return samples;
}

// Three runs, each channel of whose truth went through this.
template <typename Filter>
std::vector<Recording> runs_through(const Filter& filter, const GeneratorSettings& g = by_radio()) {
  Random random(17);
  std::vector<Recording> recordings;
  for (int run = 0; run < 3; ++run) {
    recordings.push_back(generated(g, test::rich_driving, random));
    std::erase_if(recordings.back().channels, [](const Channel& c) { return c.name == "truth_heading_rad"; });
    for (const char* channel : {"truth_x_m", "truth_y_m"}) filter(truth_of(recordings.back(), channel), random);
  }
  return recordings;
}

LeastSquaresCalibration calibrated_by_radio(const std::vector<Recording>& recordings) {
  const auto result = calibrate_least_squares(recordings, Vehicle{"LabMate", DifferentialDrive{}, {}});
  EXPECT_TRUE(result.ok());
  return result.ok() ? *result : LeastSquaresCalibration{};
}

void expect_true_wheelbase(const LeastSquaresCalibration& c) {
  for (const ParameterEstimate& p : c.parameters)
    if (p.name == "wheelbase_m") {
      EXPECT_NEAR(p.value, by_radio().drive.wheelbase_m, 4.0 * p.stderr_value);
    }
}

void low_pass(const std::vector<double*>& samples, double share) {
  for (std::size_t i = 1; i < samples.size(); ++i)
    *samples[i] = *samples[i - 1] + share * (*samples[i] - *samples[i - 1]);
}

TEST(UnfilteredTruth, TheTimeOfALowPassIsFoundAndItsMeanDelayIsTheClocks) {
  constexpr double kTime_s = 0.8;
  const LeastSquaresCalibration c = calibrated_by_radio(runs_through(
      [](const std::vector<double*>& samples, Random&) { low_pass(samples, 1.0 - std::exp(-0.1 / kTime_s)); }));
  ASSERT_TRUE(c.truth_filter);
  EXPECT_EQ(c.truth_filter->kind, TruthFilter::Kind::low_pass);
  EXPECT_NEAR(c.truth_filter->time_constant_s, kTime_s, 0.04);  // 3600 samples tell it to about 2 %
  for (const double late_s : c.time_offset_s) EXPECT_NEAR(late_s, c.truth_filter->late_s(), 0.05);
  expect_true_wheelbase(c);
}

TEST(UnfilteredTruth, ALowPassOfALowPassIsToldFromOne) {
  const LeastSquaresCalibration c = calibrated_by_radio(runs_through([](const std::vector<double*>& samples, Random&) {
    for (int twice = 0; twice < 2; ++twice) low_pass(samples, 1.0 - std::exp(-0.1 / 0.4));
  }));
  ASSERT_TRUE(c.truth_filter);
  EXPECT_EQ(c.truth_filter->kind, TruthFilter::Kind::low_pass_twice);
  EXPECT_NEAR(c.truth_filter->time_constant_s, 0.4, 0.04);
  expect_true_wheelbase(c);
}

TEST(UnfilteredTruth, OneThatCarriesThePoseOnIsNotLate) {
  const LeastSquaresCalibration c = calibrated_by_radio(runs_through([](const std::vector<double*>& samples, Random&) {
    const double a = 0.2, b = 2.0 * (2.0 - a) - 4.0 * std::sqrt(1.0 - a);
    double way = 0.0;  // in a period
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const double carried = *samples[i - 1] + way, off = *samples[i] - carried;
      *samples[i] = carried + a * off, way += b * off;
    }
  }));
  ASSERT_TRUE(c.truth_filter);
  EXPECT_EQ(c.truth_filter->kind, TruthFilter::Kind::constant_velocity);
  for (const double late_s : c.time_offset_s) EXPECT_NEAR(late_s, 0.0, 0.05);
  expect_true_wheelbase(c);
}

// Noise that lasts is no filter: the vehicle's way is not late.
TEST(UnfilteredTruth, NoiseThatLastsByItselfIsNoFilter) {
  GeneratorSettings exact = by_radio();
  exact.truth_position_noise_m = 0.0;
  for (const double time_s : {0.7, 2.0}) {
    const LeastSquaresCalibration c = calibrated_by_radio(runs_through(
        [&](const std::vector<double*>& samples, Random& random) {
          const double kept = std::exp(-0.1 / time_s);
          double error = 0.03 * random.normal();
          for (double* sample : samples) {
            *sample += error;
            error = kept * error + 0.03 * std::sqrt(1.0 - kept * kept) * random.normal();
          }
        },
        exact));
    EXPECT_FALSE(c.truth_filter) << time_s;
  }
}

// A mean over the last second has no past of its own to solve for.
TEST(UnfilteredTruth, AMeanOfTheLastSamplesIsAnother) {
  const LeastSquaresCalibration c = calibrated_by_radio(runs_through([](const std::vector<double*>& samples, Random&) {
    std::vector<double> measured;
    for (double* sample : samples) {
      measured.push_back(*sample);
      const std::size_t n = std::min<std::size_t>(measured.size(), 10);
      *sample = 0.0;
      for (std::size_t k = 0; k < n; ++k) *sample += measured[measured.size() - 1 - k] / static_cast<double>(n);
    }
  }));
  EXPECT_FALSE(c.truth_filter);
  EXPECT_GT(c.truth_apart_s, 0.0);
}

TEST(UnfilteredTruth, IndependentSamplesAreTakenAsTheyAre) {
  const LeastSquaresCalibration c = calibrated_by_radio(runs_through([](const std::vector<double*>&, Random&) {}));
  EXPECT_FALSE(c.truth_filter);
  expect_true_wheelbase(c);
}

}  // namespace
}  // namespace odolab
