#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kKnocked_s = 31.0, kKnockedAhead_m = 0.006, kKnockedLeft_m = -0.004;

// Three runs of a robot whose marker is knocked on the way of the second one, and sits where it did in the third.
std::vector<Recording> knocked_runs(bool with_headings, double turned_rad = 0.0) {
  Random random(with_headings ? 83 : 84);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.02);
  g.duration_s = 60.0;
  g.truth_has_heading = with_headings;
  std::vector<Pose> pose_at_ms(static_cast<std::size_t>(1e3 * g.duration_s) + 1);
  std::vector<Recording> runs = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); },
      [&](int run) {
        return [&, run](InjectedStep& s) {
          if (run == 1) pose_at_ms[static_cast<std::size_t>(std::lround(1e3 * s.time_s))] = s.pose;
        };
      });
  Recording& r = runs[1];
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    if (r.time_s[i] < kKnocked_s) continue;
    const Vec2 by =
        rotated({kKnockedAhead_m, kKnockedLeft_m}, pose_at_ms[static_cast<std::size_t>(1e3 * r.time_s[i])].heading_rad);
    for (Channel& c : r.channels) {
      if (c.name == "truth_x_m") c.values[i] += by.x_m;
      if (c.name == "truth_y_m") c.values[i] += by.y_m;
      if (c.name == "truth_heading_rad") c.values[i] += turned_rad;
    }
  }
  return runs;
}

void expect_said_of_the_truth(const Diagnosis& d, const char* words) {
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const Finding& f = d.findings.front();
  EXPECT_EQ(f.component, "truth");
  EXPECT_EQ(f.where.recording, "run_2");
  ASSERT_EQ(f.where.time_s.size(), 1u);
  // Moments are looked for 0.12 s apart, and a tenth of a second about them.
  EXPECT_NEAR(f.where.time_s.front().first, kKnocked_s, 0.25);
  EXPECT_NE(f.where.regime.find(words), std::string::npos) << f.where.regime;
}

// At its moment that had been a push of 7 mm.
TEST(KnockedMarker, IsNoPush) {
  for (const bool with_headings : {true, false}) {
    SCOPED_TRACE(with_headings);
    expect_said_of_the_truth(diagnose(knocked_runs(with_headings), {}, Vehicle{}).value(), "sits elsewhere");
  }
}

TEST(KnockedMarker, IsSaidWithTheAngleThatItIsTurnedBy) {
  constexpr double kTurned_rad = 0.05;
  const Diagnosis d = diagnose(knocked_runs(true, kTurned_rad), {}, Vehicle{}).value();
  expect_said_of_the_truth(d, "to the left, as where a marker is knocked");
  const std::string& regime = d.findings.front().where.regime;
  const std::size_t at = regime.find("turned by ");
  ASSERT_NE(at, std::string::npos) << regime;
  // Its samples are 2 mrad off, and the mean of a mount before and behind is taken off both.
  EXPECT_NEAR(std::strtod(regime.c_str() + at + 10, nullptr) * kPi / 180.0, kTurned_rad, 0.003) << regime;
}

// Three runs; in the second the truth's clock is set while it runs: from 31 s on it shows what will be in 120 ms.
std::vector<Recording> runs_under_a_clock_that_is_set() {
  constexpr std::size_t kRows = 6;  // of 20 ms
  Random random(85);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.02);
  g.duration_s = 60.0;
  std::vector<Recording> runs = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, [](int) { return [](InjectedStep&) {}; });
  Recording& r = runs[1];
  std::vector<std::size_t> rows;  // of the truth
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    if (!std::isnan(r.channel("truth_x_m")->values[i])) rows.push_back(i);
  for (Channel& c : r.channels) {
    if (c.name.rfind("truth_", 0) != 0) continue;
    const std::vector<double> was = c.values;
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (r.time_s[rows[k]] > kKnocked_s) c.values[rows[k]] = was[rows[std::min(k + kRows, rows.size() - 1)]];
  }
  return runs;
}

TEST(ClockThatIsSet, IsNoPush) {
  expect_said_of_the_truth(diagnose(runs_under_a_clock_that_is_set(), {}, Vehicle{}).value(), "earlier");
}

}  // namespace
}  // namespace odolab::test
