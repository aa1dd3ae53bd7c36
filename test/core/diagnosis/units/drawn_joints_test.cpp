#include "core/diagnosis/units/drawn_joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

constexpr double kStep_rad = 2.0 * kPi / 1200.0;  // a CLAPPER's, 0.3 degrees

// A link that swings by 3 degrees every few metres, and stands for ten seconds on the way; `true_rad` what it really
// was.
struct Swinging {
  std::vector<UnitSample> samples;
  std::vector<double> true_rad;
};

Swinging swinging(double step_rad) {
  Swinging s;
  double way_rad = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double time_s = 0.025 * i;
    if (time_s < 43.0 || time_s > 53.0) way_rad += 0.1;
    s.true_rad.push_back(0.05 * std::sin(0.11 * way_rad));
    const double read = step_rad > 0.0 ? step_rad * std::round(s.true_rad.back() / step_rad) : s.true_rad.back();
    s.samples.push_back({time_s, {{way_rad, way_rad}}, {read}});
  }
  return s;
}

double rms_error_rad(const Swinging& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.samples.size(); ++i) sum += std::pow(s.samples[i].joints[0] - s.true_rad[i], 2);
  return std::sqrt(sum / static_cast<double>(s.samples.size()));
}

TEST(DrawnJoints, AreKnownFiveTimesBetterThanTheirSteps) {
  Swinging s = swinging(kStep_rad);
  for (UnitSample& sample : s.samples)  // as it is printed
    sample.joints[0] = std::round(1e5 * sample.joints[0]) / 1e5;
  const double as_read_rad = rms_error_rad(s);
  s.samples = with_joints_drawn(s.samples);
  // At full pace it moves by a tenth of a step from reading to reading, and no edge is known better.
  EXPECT_LT(rms_error_rad(s), 0.2 * as_read_rad);
}

TEST(DrawnJoints, AreNeverFurtherFromWhatWasReadThanHalfAStep) {
  Swinging read = swinging(kStep_rad);
  for (UnitSample& s : read.samples)  // in the end from one side to the other at once, where it stays for metres
    if (s.time_s > 60.0) s.joints[0] = std::copysign(10.0 * kStep_rad, s.joints[0]);
  const std::vector<UnitSample> drawn = with_joints_drawn(read.samples);
  for (std::size_t i = 0; i < drawn.size(); ++i)
    ASSERT_LE(std::abs(drawn[i].joints[0] - read.samples[i].joints[0]), 0.5 * kStep_rad + 1e-12) << i;
}

// What errs at random by half a step and is rounded then is right in the mean, and at no edge.
TEST(DrawnJoints, WhoseReadingsFlickerAreAsTheyAreRead) {
  Random random(7);
  Swinging read = swinging(0.0);
  for (UnitSample& s : read.samples)
    s.joints[0] = kStep_rad * std::round(s.joints[0] / kStep_rad + 0.5 * random.normal());
  const std::vector<UnitSample> drawn = with_joints_drawn(read.samples);
  for (std::size_t i = 0; i < drawn.size(); ++i) ASSERT_EQ(drawn[i].joints[0], read.samples[i].joints[0]) << i;
}

TEST(DrawnJoints, OfNoStepAreAsTheyAreRead) {
  Random random(7);
  Swinging read = swinging(0.0);
  for (UnitSample& s : read.samples) s.joints[0] += 1e-4 * random.normal();
  const std::vector<UnitSample> drawn = with_joints_drawn(read.samples);
  for (std::size_t i = 0; i < drawn.size(); ++i) ASSERT_EQ(drawn[i].joints[0], read.samples[i].joints[0]) << i;
}

}  // namespace
}  // namespace odolab
