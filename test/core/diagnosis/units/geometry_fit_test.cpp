#include "core/diagnosis/units/geometry_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/units/outside_truth.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// A camera that errs by half a degree throws a trailer half a metre behind by 4 mm to the side, more than it errs in
// place. With derivatives of poses as they were measured a drawbar had come out 3 % short.
TEST(GeometryFit, KnowsADrawbarThoughHeadingsErr) {
  EncoderTrailer file, actual;
  actual.drawbar_length_m *= 1.008;
  LinkedRunSettings s;
  s.truth_m = 0.003;
  s.truth_rad = 0.01;
  s.duration_s = 60.0;
  double off_in_errors = 0.0, off_m = 0.0;
  constexpr int kFits = 4;
  for (int fit = 0; fit < kFits; ++fit) {
    std::vector<JoinedRun> runs;
    for (std::uint64_t k = 0; k < 3; ++k) {
      const Recording r = trailer_run(actual, s, 901 + 10 * static_cast<std::uint64_t>(fit) + k);
      runs.push_back({unit_samples(r, vehicle_of(file)), tracked_poses(r)});
    }
    for (const JointEstimate& e : fitted_geometry(runs, vehicle_of(file)).joints)
      if (e.parameter.name == "drawbar_length_m") {
        ASSERT_TRUE(e.determined);
        off_m += (e.value - actual.drawbar_length_m) / kFits;
        off_in_errors += (e.value - actual.drawbar_length_m) / e.stderr_value / std::sqrt(kFits);
      }
  }
  EXPECT_LT(std::abs(off_in_errors), 3.0) << 1e3 * off_m << " mm";
  EXPECT_LT(std::abs(off_m), 0.006 * actual.drawbar_length_m);
}

}  // namespace
}  // namespace odolab::test
