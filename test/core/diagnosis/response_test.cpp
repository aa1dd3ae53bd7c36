#include <gtest/gtest.h>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

TEST(DiagnoseResponses, OfAnEccentricWheelFollowItsAngleAndAreGoneWithTheFinding) {
  test::CaseSettings settings;
  settings.effect = "wheel_eccentricity";
  settings.size = 5.0;
  settings.runs = 2;
  settings.duration_s = 40.0;
  const test::Case c = test::generated_case(settings, 3);
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  ASSERT_FALSE(d->findings.empty());
  ASSERT_EQ(d->findings[0].effect, "wheel_eccentricity");
  // the strongest is of a wheel's angle; its sister is of the other wheel, at the same strength of their group
  ASSERT_GE(d->responses.size(), 2u);
  double largest = 0.0, left = 0.0;
  bool leaves_zero = false;
  for (std::size_t k = 0; k < 2; ++k) {
    const Response& r = d->responses[k];
    EXPECT_NE(r.variable.find("wheel angle"), std::string::npos) << r.variable;
    ASSERT_EQ(r.after.size(), r.value.size());
    for (std::size_t i = 0; i < r.at.size(); ++i) {
      largest = std::max(largest, std::abs(r.value[i]));
      left = std::max(left, std::abs(r.after[i]));
      leaves_zero = leaves_zero || r.low[i] > 0.0 || r.high[i] < 0.0;
    }
  }
  EXPECT_TRUE(leaves_zero);
  EXPECT_LT(left, 0.3 * largest);  // what is left is noise
}

}  // namespace
}  // namespace odolab
