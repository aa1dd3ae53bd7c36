#include "core/diagnosis/generic/truth_by_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// A column of steel pulls a compass towards it, by so much at its foot and a metre away by 0.6 of that.
TEST(TruthByPlace, ShowsACompassThatAColumnOfSteelTurns) {
  constexpr double kDeviation_rad = 0.006, kReaches_m = 1.0;
  test::CaseSettings settings;
  settings.runs = 3;
  settings.duration_s = 60.0;
  test::Case c = test::generated_case(settings, 24);
  const auto channel = [](Recording& r, const char* name) -> std::vector<double>& {
    return std::find_if(r.channels.begin(), r.channels.end(), [&](const Channel& c) { return c.name == name; })->values;
  };
  std::vector<double> xs, ys;
  for (Recording& r : c.recordings)
    for (std::size_t i = 0; i < channel(r, "truth_x_m").size(); ++i)
      if (std::isfinite(channel(r, "truth_x_m")[i]))
        xs.push_back(channel(r, "truth_x_m")[i]), ys.push_back(channel(r, "truth_y_m")[i]);
  const auto middle = [](std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  const Vec2 column{middle(xs) + 0.3, middle(ys)};
  for (Recording& r : c.recordings) {
    const std::vector<double>&x = channel(r, "truth_x_m"), &y = channel(r, "truth_y_m");
    std::vector<double>& heading = channel(r, "truth_heading_rad");
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(heading[i])) continue;
      const Vec2 to = column - Vec2{x[i], y[i]};
      heading[i] += kDeviation_rad * std::exp(-0.5 * dot(to, to) / (kReaches_m * kReaches_m)) *
                    std::sin(std::atan2(to.y_m, to.x_m) - heading[i]);
    }
  }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_EQ(d->findings.front().component, "truth");
  EXPECT_EQ(d->findings.front().where.regime, "truth's heading that depends on place on the floor, and heading there");
}

}  // namespace
}  // namespace odolab
