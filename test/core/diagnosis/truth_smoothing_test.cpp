#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/mismatch.h"
#include "core/odometry/prediction.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kTruthPeriod_s = 0.01;
constexpr const char* kPose[] = {"truth_x_m", "truth_y_m", "truth_heading_rad"};

// What a tracker makes of one of its channels.
using Filter = std::function<std::vector<double>(const std::vector<double>&)>;

// Followed by one of first order with that time constant.
Filter of_first_order(double time_constant_s) {
  return [=](const std::vector<double>& in) {
    const double keep = std::exp(-kTruthPeriod_s / time_constant_s);
    std::vector<double> out = {in.front()};
    for (std::size_t i = 1; i < in.size(); ++i) out.push_back(in[i] + keep * (out.back() - in[i]));
    return out;
  };
}

// The mean of the last so many samples.
Filter mean_of_last(std::size_t samples) {
  return [=](const std::vector<double>& in) {
    std::vector<double> out;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const std::size_t n = std::min(samples, i + 1);
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += in[i - k];
      out.push_back(sum / static_cast<double>(n));
    }
    return out;
  };
}

// Three runs under motion capture that comes a hundred times a second through that filter; a millimetre and two
// milliradians of noise behind it.
std::vector<Recording> smoothed_runs(const Filter& filter, const std::function<void(InjectedStep&)>& inject = {}) {
  Random random(83);
  GeneratorSettings g;
  g.drive = {0.0753, 0.0748, 0.343};
  g.wheel_noise = 0.0008;
  g.truth_period_s = kTruthPeriod_s;
  g.duration_s = 45.0;
  g.inject = inject;
  std::vector<Recording> runs;
  for (int run = 0; run < 3; ++run) {
    Recording r = generated(g, varied_driving(random, g.duration_s), random);
    r.name = "run_" + std::to_string(run + 1);
    for (Channel& c : r.channels) {
      const auto axis = std::find(std::begin(kPose), std::end(kPose), c.name);
      if (axis == std::end(kPose)) continue;
      std::vector<double> seen;
      for (const double v : c.values)
        if (!std::isnan(v)) seen.push_back(v);
      seen = filter(seen);
      std::size_t next = 0;
      for (double& v : c.values)
        if (!std::isnan(v)) v = seen[next++] + (axis == kPose + 2 ? 0.002 : 0.001) * random.normal();
    }
    runs.push_back(std::move(r));
  }
  return runs;
}

const Finding* finding(const Diagnosis& d, const std::string& effect) {
  for (const Finding& f : d.findings)
    if (f.effect == effect) return &f;
  return nullptr;
}

std::string said(const Diagnosis& d) {
  std::string all;
  for (const Finding& f : d.findings) all += f.effect + " of " + f.component + "; ";
  return all;
}

// The width of a filter of first order is its time constant, and by nearly as much it is late. What it does beyond the
// second moment is worth a twentieth at this driving.
TEST(TruthSmoothing, IsNamedWithTheTimeConstantOfAFilterThatIsLateByAsMuch) {
  const Diagnosis d = diagnose(smoothed_runs(of_first_order(0.06)), {}, Vehicle{}).value();
  EXPECT_EQ(d.verdict, Verdict::found);
  EXPECT_EQ(d.findings.size(), 2u) << said(d);
  const Finding *smoothing = finding(d, "truth_smoothing"), *late = finding(d, "truth_time_offset");
  ASSERT_TRUE(smoothing && late) << said(d);
  EXPECT_EQ(smoothing->component, "truth");
  EXPECT_EQ(smoothing->parameters[0].name, "width_s");
  EXPECT_NEAR(smoothing->parameters[0].value, 0.06, 0.05 * 0.06 + 3.0 * smoothing->parameters[0].stderr_value);
  const double keep = std::exp(-kTruthPeriod_s / 0.06),
               late_s = kTruthPeriod_s * keep / (1.0 - keep);  // in steps of a sample
  EXPECT_NEAR(late->parameters[0].value, late_s, 0.03 * late_s);
}

// In the picture, too, it is a mismatch that is gone with it: each under its own noise, that of the model without it
// had looked the smaller.
TEST(TruthSmoothing, IsDrawnAsAMismatchThatIsGoneWithIt) {
  const Diagnosis d = diagnose(smoothed_runs(of_first_order(0.06)), {}, Vehicle{}).value();
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  for (int run = 1; run <= 3; ++run) {
    const MismatchOverTime m = mismatch_over_time(d, "run_" + std::to_string(run));
    ASSERT_FALSE(m.after.empty());
    EXPECT_GT(mean(m.before), 1.2 * mean(m.after)) << run;
    EXPECT_GT(m.largest_before(0.0, 45.0), 1.5 * m.largest_after(0.0, 45.0)) << run;
  }
}

// Evenly over a window of 0.2 s: a width of 0.2 s / sqrt(12), and late by half of it less half a sample.
TEST(TruthSmoothing, IsAsWideAsTheWindowOfAMeanScatters) {
  const Diagnosis d = diagnose(smoothed_runs(mean_of_last(20)), {}, Vehicle{}).value();
  EXPECT_EQ(d.findings.size(), 2u) << said(d);
  const Finding *smoothing = finding(d, "truth_smoothing"), *late = finding(d, "truth_time_offset");
  ASSERT_TRUE(smoothing && late) << said(d);
  const double width_s = 0.2 / std::sqrt(12.0);
  EXPECT_NEAR(smoothing->parameters[0].value, width_s, 0.05 * width_s + 3.0 * smoothing->parameters[0].stderr_value);
  EXPECT_NEAR(late->parameters[0].value, 0.095, 0.05 * 0.095);
}

// However much the smoothing explains, what the vehicle does stands beside it.
TEST(TruthSmoothing, HidesNothingThatTheVehicleDoes) {
  const auto slipping = [](InjectedStep& s) {
    const double v = 0.5 * 0.075 * (s.left_radps + s.right_radps), w = 0.075 * (s.right_radps - s.left_radps) / 0.343;
    s.sideways_m -= 0.012 * v * w * s.dt_s;
  };
  const Diagnosis d = diagnose(smoothed_runs(of_first_order(0.06), slipping), {}, Vehicle{}).value();
  const Finding *smoothing = finding(d, "truth_smoothing"), *slip = finding(d, "lateral_slip");
  ASSERT_TRUE(smoothing && slip) << said(d);
  EXPECT_EQ(d.findings.size(), 3u) << said(d);
  EXPECT_NEAR(slip->parameters[0].value, 0.012, 4.0 * slip->parameters[0].stderr_value);
  EXPECT_NEAR(smoothing->parameters[0].value, 0.06, 0.005);
}

TEST(TruthSmoothing, IsNotNamedWhereTheTruthIsAsItIs) {
  const Diagnosis d = diagnose(smoothed_runs([](const std::vector<double>& in) { return in; }), {}, Vehicle{}).value();
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
}

// A base that follows its commands with a lag goes as a smoothed truth says.
// Thirty counts a turn, 16 mm each: a wheel that sets off evenly is read as in a jump. Of an eighteenth program's 35
// recordings in which nothing was missing, seven had had a smoothed truth for it.
TEST(TruthSmoothing, IsNotNamedWhereWholeCountsDoAsMuch) {
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, kTruthPeriod_s);
  g.drive.encoder_counts_per_revolution = 30.0;
  g.duration_s = 45.0;
  Vehicle nominal;
  std::get<DifferentialDrive>(nominal.kind).encoder_counts_per_revolution = 30.0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Random random(seed);
    const auto nothing = [](int) { return [](InjectedStep&) {}; };
    const std::vector<Recording> runs = three_runs(
        g, random, [&](int) { return varied_driving(random, g.duration_s); }, nothing);
    const Diagnosis d = diagnose(runs, {}, nominal).value();
    EXPECT_EQ(finding(d, "truth_smoothing"), nullptr) << said(d);
  }
}

TEST(TruthSmoothing, IsNotAskedForWhereThereAreCommandsAlone) {
  DriveView view;
  view.steps.resize(3);
  view.from_commands = true;
  EXPECT_TRUE(effects::truth_smoothing().front().motions(view, {}).front().empty());
  view.from_commands = false;
  EXPECT_FALSE(effects::truth_smoothing().front().motions(view, {}).front().empty());
}

// The track of a model with it is that of the smoothed truth: inside of the vehicle's in a bend, by half the square of
// the width times the lateral acceleration.
TEST(TruthSmoothing, CutsCornersInThePredictedTrack) {
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  g.counts = false;
  g.duration_s = 12.0;
  Random random(1);
  const Recording circle = generated(
      g,
      [](double t) {
        const double share = std::clamp(t - 1.0, 0.0, 1.0);
        return WheelSpeedsAt{5.0 * share, 8.0 * share};
      },
      random);
  Vehicle vehicle;
  vehicle.kind = g.drive;
  const Track plain = predicted_track(circle, vehicle).value();
  const Track with = predicted_track(circle, vehicle, {{"truth_smoothing", "truth", {{"width_s", 0.1}}}}).value();
  const double v = 0.075 * 6.5, w = 0.075 * 3.0 / 0.34;
  const Pose a = *pose_at(plain, 10.0), b = *pose_at(with, 10.0);
  const Vec2 inside = rotated(b.position() - a.position(), -a.heading_rad);
  EXPECT_NEAR(inside.y_m, 0.5 * 0.1 * 0.1 * v * w, 0.03 * 0.5 * 0.1 * 0.1 * v * w);
  EXPECT_NEAR(inside.x_m, 0.0, 1e-4);
  EXPECT_NEAR(b.heading_rad, a.heading_rad, 1e-4);
}

}  // namespace
}  // namespace odolab::test
