#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "core/base/random.h"
#include "core/diagnosis/diagnosis.h"
#include "test/support/short_cases.h"

namespace odolab::test {
namespace {

constexpr double kFrame_s = 1.0 / 60.0;
constexpr std::size_t kFrames = 5;

// Goes, stops for two seconds, turns, stops, and so on: at most 0.5 m/s and 1.5 rad/s, reached in half a second.
SpeedProfile goes_and_stops(std::uint64_t seed) {
  return [seed](double t) {
    constexpr double kLeg_s = 4.5, kGoes_s = 2.5, kEdge_s = 0.5;
    const auto leg = static_cast<std::uint64_t>(t / kLeg_s);
    const double since_s = t - kLeg_s * static_cast<double>(leg);
    Random random(1000 * seed + leg);
    const double forward = random.uniform(-3.0, 6.0), turning = random.uniform(-1.0, 1.0) * (leg % 2 ? 2.5 : 0.3);
    WheelSpeedsAt w;
    if (since_s >= kGoes_s) return w;
    const double edge = std::min({1.0, since_s / kEdge_s, (kGoes_s - since_s) / kEdge_s});
    const double s = 0.5 - 0.5 * std::cos(kPi * edge);
    w.left_radps = s * (forward - turning);
    w.right_radps = s * (forward + turning);
    return w;
  };
}

// Of 60 frames a second each is handed on as the mean of the last five: its noise, what it is off by for a second or
// two, and the way.
void hand_on_means(Recording& r, std::uint64_t seed) {
  constexpr double kOff_m = 0.0003, kOff_rad = 0.0004, kLasts_s = 1.6;
  Random random(seed);
  const double stays = std::exp(-kFrame_s / kLasts_s), more = std::sqrt(1.0 - stays * stays);
  double off[3] = {};
  std::deque<std::array<double, 3>> last;
  change_truth(r, [&](std::size_t, double& x, double& y, double& heading) {
    for (double& o : off) o = stays * o + more * random.normal();
    heading += kOff_rad * off[2];
    if (!last.empty()) heading = last.back()[2] + wrapped(heading - last.back()[2]);
    last.push_back({x + kOff_m * off[0], y + kOff_m * off[1], heading});
    if (last.size() > kFrames) last.pop_front();
    std::array<double, 3> sum = {};
    for (const auto& pose : last)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += pose[k] / static_cast<double>(last.size());
    x = sum[0], y = sum[1], heading = wrapped(sum[2]);
  });
}

// A mean over 83 ms is what a smoothing by 24 ms is, and less than what stands for it by itself. What it left had no
// name.
TEST(SmoothedTruth, IsKnownByItsRestsBesideAnErrorThatLasts) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    GeneratorSettings g = under_motion_capture({0.06, 0.0601, 0.3}, 0.0005, kFrame_s, 0.0003, 0.001);
    g.duration_s = 120.0;
    Random random(seed);
    std::vector<Recording> recordings;
    for (std::uint64_t run = 0; run < 3; ++run) {
      recordings.push_back(generated(g, goes_and_stops(10 * seed + run), random));
      recordings.back().name = "run_" + std::to_string(run + 1);
      hand_on_means(recordings.back(), 10 * seed + run);
    }
    const Result<Diagnosis> d = diagnose(recordings, {}, Vehicle{});
    ASSERT_TRUE(d);
    EXPECT_EQ(said(*d), "truth_smoothing:truth truth_time_offset:truth ") << seed;
    if (d->findings.empty() || d->findings[0].effect != "truth_smoothing") continue;
    // Readings give accelerations that are smoothed themselves, so that it seems wider, by up to a sixth; the error of
    // a fit is 3 % beside that.
    EXPECT_NEAR(d->findings[0].parameters[0].value, kFrames * kFrame_s / std::sqrt(12.0), 0.2 * 0.024) << seed;
  }
}

}  // namespace
}  // namespace odolab::test
