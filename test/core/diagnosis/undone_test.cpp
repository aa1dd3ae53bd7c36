#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Encoders that are read ten times a second: a truth that goes elsewhere for 0.7 s and comes back does both within a
// step, whose samples were left to be found elsewhere once more.
TEST(Undone, IsLeftOutWithTheStepsInWhichItGoesAndReturns) {
  constexpr double kBegins_s = 20.11, kLasts_s = 0.7, kMost_rad = 0.006;
  Random random(41);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 3e-4, 0.01, 0.0003, 0.001);
  g.duration_s = 40.0;
  g.wheel_period_s = 0.1;
  std::vector<Recording> runs = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); },
      [](int) { return std::function<void(InjectedStep&)>(); });
  for (Channel& c : runs[1].channels) {
    const double most = c.name == "truth_heading_rad" ? kMost_rad
                        : c.name == "truth_x_m"       ? 0.3 * kMost_rad
                        : c.name == "truth_y_m"       ? 0.2 * kMost_rad
                                                      : 0.0;
    for (std::size_t i = 0; i < runs[1].time_s.size(); ++i) {
      const double gone = (runs[1].time_s[i] - kBegins_s) / kLasts_s;
      if (gone > 0.0 && gone < 1.0) c.values[i] += most * std::sin(kPi * gone);
    }
  }
  const Diagnosis d = diagnose(runs, {}, Vehicle{}).value();
  const auto times = std::count_if(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("the truth is elsewhere") != std::string::npos;
  });
  EXPECT_EQ(times, 1);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
}

}  // namespace
}  // namespace odolab::test
