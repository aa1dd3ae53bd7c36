#include "core/guide/rest.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

// Five returns each way whose clockwise centre lies `rest_m` from the origin and which scatter about it by `half_m`.
RestOfCalibration rest_after(double rest_m, double half_m, int each_way = 5) {
  UmbmarkRuns runs;
  runs.side_m = 4.0;
  for (int i = 0; i < each_way; ++i) {
    const double off_m = each_way == 1 ? 0.0 : i % 2 == 0 ? half_m : -half_m;
    runs.clockwise.push_back({rest_m + off_m, off_m, 0.0});
    runs.counter_clockwise.push_back({off_m, -off_m, 0.0});
  }
  return rest_of(*measure_umbmark(runs), runs);
}

TEST(RestOfCalibration, AsksForAnotherAboveThreeStandardErrors) {
  // The spread of five points at + - + - + is sqrt(2 * 4.8 / 8) = 1.1 times their way off on both axes: 11 mm, of which
  // the standard error is 4.9 mm.
  EXPECT_TRUE(rest_after(0.030, 0.010).worth_another);
  EXPECT_FALSE(rest_after(0.010, 0.010).worth_another);
  EXPECT_NE(rest_after(0.010, 0.010).sentence.find("within the spread of the returns"), std::string::npos);
}

TEST(RestOfCalibration, DoesNotChaseATenthOfAMillimetreOnAPerfectFloor) {
  for (const double scatter_m : {0.0, 1e-6, 1e-5}) EXPECT_FALSE(rest_after(0.0001, scatter_m).worth_another);
  // A millimetre is more than three times half a millimetre over the root of five.
  EXPECT_TRUE(rest_after(0.001, 0.0).worth_another);
}

TEST(RestOfCalibration, CannotTellFromOneRunEachWay) {
  EXPECT_FALSE(rest_after(0.2, 0.0, 1).worth_another);
  EXPECT_NE(rest_after(0.2, 0.0, 1).sentence.find("nobody can tell"), std::string::npos);
}

}  // namespace
}  // namespace odolab
