#include "core/diagnosis/quality/no_fix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/short_cases.h"

namespace odolab::test {
namespace {

Recording at_places(const std::vector<double>& x_m) {
  Recording r;
  r.name = "run";
  r.time_s.resize(x_m.size());
  for (std::size_t i = 0; i < x_m.size(); ++i) r.time_s[i] = 0.1 * static_cast<double>(i);
  r.add_channel("truth_x_m").values = x_m;
  r.add_channel("truth_y_m").values.assign(x_m.size(), 0.0);
  r.add_channel("truth_heading_rad").values.assign(x_m.size(), 0.0);
  return r;
}

TEST(NoFix, IsExactlyTheOriginFarFromWhereTheVehicleIs) {
  EXPECT_EQ(rows_without_fix(at_places({0.0, 2.0, 0.0, 0.0, 2.1, 2.2, 0.0})), (std::vector<char>{1, 0, 1, 1, 0, 0, 1}));
}

TEST(NoFix, IsNoneWhereTheVehicleSetsOffFromTheOriginOrComesBackToIt) {
  for (const auto& x_m : {std::vector<double>{0.0, 0.0, 0.1, 1.0, 2.0}, {2.0, 1.0, 0.15, 0.0, 0.0}, {0.0, 0.0, 0.0}})
    EXPECT_EQ(rows_without_fix(at_places(x_m)), std::vector<char>(x_m.size(), 0));
}

// A camera that sees no tag in every fifth row had made wheels that scatter by 78 mm per root metre.
TEST(NoFix, IsLeftOutAndSaid) {
  Case c = generated_case(short_case("", 0.0), 7508);
  Recording& r = c.recordings[1];
  int rows = 0;
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    double* pose[3] = {};
    for (Channel& channel : r.channels)
      if (channel.name.rfind("truth_", 0) == 0)
        pose[channel.name == "truth_x_m" ? 0 : channel.name == "truth_y_m" ? 1 : 2] = &channel.values[i];
    if (!std::isfinite(*pose[0])) continue;
    for (double* p : pose) *p += p == pose[2] ? 0.0 : 5.0;  // the room's corner is elsewhere
    if (++rows % 5 == 0)
      for (double* p : pose) *p = 0.0;
  }
  const Diagnosis d = diagnosed(c);
  EXPECT_TRUE(d.findings.empty()) << said(d);
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("run_1: the truth is exactly 0, 0 in ") == 0;
  })) << said(d);
}

}  // namespace
}  // namespace odolab::test
