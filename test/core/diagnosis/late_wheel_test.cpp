#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Stops and goes, straight and in bends, hard on and hard off.
WheelSpeedsAt hard_on_and_off(double t, int run) {
  const double in_go_s = std::fmod(t, 4.0), way = 6.0 * std::clamp(4.0 * std::min(in_go_s, 3.0 - in_go_s), 0.0, 1.0);
  const double bend = 0.3 * std::sin(0.37 * t + run);
  return {way * (1.0 - bend), way * (1.0 + bend)};
}

// The same, and crawls in between, so slowly that most readings have no count.
WheelSpeedsAt hard_and_crawling(double t, int run) {
  const WheelSpeedsAt fast = hard_on_and_off(t, run);
  const double crawl_radps = 0.08 * std::abs(std::sin(0.7 * t + run));
  return {std::max(fast.left_radps, crawl_radps), std::max(fast.right_radps, crawl_radps)};
}

using Driven = WheelSpeedsAt (*)(double t, int run);

std::vector<Recording> runs_of_a_loop(double right_is_newer_s, Driven driven = hard_on_and_off,
                                      double wheel_period_s = 0.02) {
  Random random(87);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0003, 0.02, 0.0003, 0.0005);
  g.wheel_period_s = wheel_period_s;
  g.duration_s = 60.0;
  return three_runs(
      g, random, [=](int run) { return [=](double t) { return driven(t, run); }; },
      [=](int run) {
        return [=](InjectedStep& s) {
          s.right_read_rad = driven(s.time_s + 0.5 * s.dt_s + right_is_newer_s, run).right_radps * s.dt_s;
        };
      });
}

// One counter is asked after the other. Half a millisecond of it had been a left wheel that slips.
TEST(LateWheel, IsNoSlipOfTheOther) {
  const Diagnosis d = diagnose(runs_of_a_loop(0.0005), {}, Vehicle{}).value();
  for (const Finding& f : d.findings)
    EXPECT_TRUE(f.effect != "traction_slip" && f.effect != "drivetrain_backlash") << f.effect << " " << f.component;
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const std::string& w) { return w.find("the right wheel's counts seem to be 0.5") == 0; }));
}

// Counts that are put right are whole no more: a wheel that crawls had been an encoder that stands still, time and
// again.
TEST(LateWheel, MakesNoFaultsOfAWheelThatCrawls) {
  const Diagnosis d = diagnose(runs_of_a_loop(0.0005, hard_and_crawling, 0.01), {}, Vehicle{}).value();
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "encoder_data_fault") << f.sentence;
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const std::string& w) { return w.find("the right wheel's counts seem to be 0.5") == 0; }));
}

// On and back by turns, with play of just less than a count in both wheels, and right counts that are 0.5 ms newer.
std::vector<Recording> runs_with_play() {
  const auto on_and_back = [](double t, int run) {
    WheelSpeedsAt w = hard_on_and_off(t, run);
    if (std::fmod(t, 16.0) > 8.0) w.left_radps = -w.left_radps, w.right_radps = -w.right_radps;
    return w;
  };
  Random random(87);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0003, 0.02, 0.0003, 0.0005);
  g.duration_s = 60.0;
  const double gap_rad = 0.95 * 2.0 * kPi / g.drive.encoder_counts_per_revolution;
  const auto crossed = [gap_rad](double by_rad, double& place_rad) {
    const double before = place_rad;
    place_rad = std::clamp(before + by_rad, 0.0, gap_rad);
    return place_rad - before;
  };
  return three_runs(
      g, random, [=](int run) { return [=](double t) { return on_and_back(t, run); }; },
      [=](int run) {
        auto left = std::make_shared<double>(0.0), right = std::make_shared<double>(0.0);
        return [=](InjectedStep& s) {
          s.left_m -= g.drive.wheel_radius_left_m * crossed(s.left_radps * s.dt_s, *left);
          s.right_m -= g.drive.wheel_radius_right_m * crossed(s.right_radps * s.dt_s, *right);
          s.right_read_rad = on_and_back(s.time_s + 0.5 * s.dt_s + 0.0005, run).right_radps * s.dt_s;
        };
      });
}

// That whole counts may feign the play had been said of the counts before they were put right, beside its finding.
TEST(LateWheel, OfWhatCountsSeemedToSayNothingStaysOnceTheyArePutRight) {
  const Diagnosis d = diagnose(runs_with_play(), {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "drivetrain_backlash");
  ASSERT_EQ(d.warnings.size(), 1u);
  EXPECT_EQ(d.warnings.front().find("the right wheel's counts seem to be 0.5"), 0u) << d.warnings.front();
}

}  // namespace
}  // namespace odolab::test
