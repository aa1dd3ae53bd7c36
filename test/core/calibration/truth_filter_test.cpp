#include "core/calibration/truth_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace odolab {
namespace {

constexpr double kEvery_s = 0.1, kTimeConstant_s = 0.7;

// What such filters make of a path of 1 m/s with noise; wheels stand in every second row and in rows of their own.
struct Filtered {
  std::vector<double> measured;
  Recording recording;
};

// `stage`: what comes out of the samples so far and the next that was measured.
template <typename Stage>
Filtered filtered_by(Stage&& stage) {
  Random random(3);
  Filtered f;
  f.recording.name = "run.csv";
  for (int i = 0; i < 200; ++i) f.recording.time_s.push_back(0.5 * kEvery_s * i);
  for (const char* name : {"left_wheel_rad", "truth_x_m", "truth_heading_rad"}) f.recording.add_channel(name);
  double last = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    f.recording.channels[0].values[i] = static_cast<double>(i);
    if (i % 2) continue;
    f.measured.push_back(f.recording.time_s[i] + 0.05 * random.normal());
    last = i == 0 ? f.measured.back() : stage(last, f.measured.back());
    f.recording.channels[1].values[i] = last;
    f.recording.channels[2].values[i] = wrapped(last);  // it turns by three and a half half-turns
  }
  return f;
}

void expect_measured(const Filtered& f, const TruthFilter& filter, std::size_t unknown) {
  const Recording solved = unfiltered_truth(f.recording, filter);
  const Channel &x = *solved.channel("truth_x_m"), &heading = *solved.channel("truth_heading_rad"),
                &wheel = *solved.channel("left_wheel_rad");
  std::size_t k = unknown, wheels = 0;
  for (std::size_t i = 0; i < solved.time_s.size(); ++i) {
    if (!std::isnan(wheel.values[i])) {
      EXPECT_NEAR(solved.time_s[i], 0.5 * kEvery_s * wheel.values[i], 1e-12);  // wheels keep their stamps
      ++wheels;
    }
    if (std::isnan(x.values[i])) continue;
    ASSERT_LT(k, f.measured.size());
    EXPECT_NEAR(solved.time_s[i], kEvery_s * static_cast<double>(k) + filter.late_s(), 1e-9);
    EXPECT_NEAR(x.values[i], f.measured[k], 1e-9);
    EXPECT_NEAR(wrapped(heading.values[i] - f.measured[k]), 0.0, 1e-9);
    ++k;
  }
  EXPECT_EQ(k, f.measured.size());
  EXPECT_EQ(wheels, 200u);
}

TEST(TruthFilter, SolvedForItsInputALowPassGivesWhatWasMeasured) {
  const double a = 1.0 - std::exp(-kEvery_s / kTimeConstant_s);
  const Filtered f = filtered_by([&](double last, double next) { return last + a * (next - last); });
  expect_measured(f, {TruthFilter::Kind::low_pass, kTimeConstant_s}, 1);
}

TEST(TruthFilter, SolvedForItsInputALowPassOfALowPassGivesWhatWasMeasured) {
  const double a = 1.0 - std::exp(-kEvery_s / kTimeConstant_s);
  std::optional<double> between;
  const Filtered f = filtered_by([&](double last, double next) {
    const double from = between.value_or(last);
    between = from + a * (next - from);
    return last + a * (*between - last);
  });
  expect_measured(f, {TruthFilter::Kind::low_pass_twice, kTimeConstant_s}, 2);
}

// Kalman's filter itself, of position and speed, once its covariance stands still.
TEST(TruthFilter, SolvedForItsInputAKalmanFilterOfAConstantVelocityGivesWhatWasMeasured) {
  // An acceleration drawn anew for each period, and noise of 1: by whichever share of the way it then goes, T is set.
  const double q = 40.0, dt = kEvery_s;
  double p00 = 1.0, p01 = 0.0, p11 = 1.0, gain = 0.0, of_speed = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double a00 = p00 + 2 * dt * p01 + dt * dt * p11 + q * std::pow(dt, 4) / 4,
                 a01 = p01 + dt * p11 + q * std::pow(dt, 3) / 2, a11 = p11 + q * dt * dt;
    gain = a00 / (a00 + 1.0), of_speed = a01 / (a00 + 1.0);
    p00 = (1 - gain) * a00, p01 = (1 - gain) * a01, p11 = a11 - of_speed * a01;
  }
  double speed = 0.0;
  const Filtered f = filtered_by([&](double last, double next) {
    const double carried = last + speed * dt, off = next - carried;
    speed += of_speed * off;
    return carried + gain * off;
  });
  expect_measured(f, {TruthFilter::Kind::constant_velocity, -dt / std::log(1.0 - gain)}, 1);
}

}  // namespace
}  // namespace odolab
