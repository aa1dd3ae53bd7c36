#include "core/diagnosis/units/geometry_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/crooked_vehicles.h"

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

TEST(GeometryFit, FindsTheOffsetsOfTheLinkAndTheClockOfTheTruth) {
  Clapper actual = crooked_clapper();
  actual.link_angle_a_offset_rad = 0.008;
  actual.link_angle_b_offset_rad = -0.012;
  actual.link_length_offset_m = 0.006;
  std::vector<JoinedRun> runs;
  for (const Recording& r : clapper_runs(actual, {}, 11)) {
    runs.push_back({unit_samples(r, vehicle_of(Clapper{})), tracked_poses(r)});
    for (TimedPose& p : runs.back().tracked) p.time_s += 0.03;
  }
  const GeometryFit fit = fitted_geometry(runs, vehicle_of(Clapper{}));
  for (const JointEstimate& e : fit.joints) {
    Vehicle truth = vehicle_of(actual);
    EXPECT_TRUE(e.determined) << e.parameter.name;
    EXPECT_NEAR(e.value, e.parameter.of(truth), 4.0 * e.stderr_value) << e.parameter.name;
    EXPECT_LT(e.stderr_value, 0.002) << e.parameter.name;
  }
  for (std::size_t r = 0; r < runs.size(); ++r) EXPECT_NEAR(fit.clock_s[r], 0.03, 4.0 * fit.clock_stderr_s[r]);
}

// Of a tracker whose clock began 100 s before the robot's, as the file says. Stretches were cut by the truth's stamps
// where the wheels' were meant: of wheels that had stopped long before, no stretch was left.
TEST(GeometryFit, FindsTheSameThoughTheTruthsClockIsAnotherOne) {
  constexpr double kLate_s = 100.0;
  const std::vector<JoinedRun> runs = joined(clapper_runs(crooked_clapper(), {}, 11), vehicle_of(Clapper{}));
  std::vector<JoinedRun> late = runs;
  for (JoinedRun& run : late)
    for (TimedPose& p : run.tracked) p.time_s += kLate_s;
  Vehicle by_late_clock = vehicle_of(Clapper{});
  by_late_clock.truth.time_offset_s = kLate_s;
  const GeometryFit fit = fitted_geometry(runs, vehicle_of(Clapper{})), other = fitted_geometry(late, by_late_clock);
  for (std::size_t k = 0; k < fit.joints.size(); ++k) {
    EXPECT_TRUE(other.joints[k].determined) << fit.joints[k].parameter.name;
    // A hundredth of what is known of them: stamps are rounded otherwise.
    EXPECT_NEAR(other.joints[k].value, fit.joints[k].value, 0.01 * fit.joints[k].stderr_value);
    EXPECT_NEAR(other.joints[k].stderr_value, fit.joints[k].stderr_value, 0.01 * fit.joints[k].stderr_value);
  }
}

TEST(GeometryFit, FindsHowFarPivotsAreApart) {
  const MultiCastor actual = castors_with_pivots_elsewhere();
  std::vector<JoinedRun> runs;
  const Vehicle nominal = vehicle_of(three_castor_vehicle());
  for (std::uint64_t k = 0; k < 3; ++k) {
    const Recording r = castor_run(actual, {}, 271 + k);
    runs.push_back({unit_samples(r, nominal), tracked_poses(r)});
  }
  GeometryFit fit = fitted_geometry(runs, nominal);
  set_most_pivots_right(fit);
  const auto& found = std::get<MultiCastor>(fit.vehicle.kind).castors;
  double variance = 0.0, offset_error_rad = 0.0;  // of a pivot's place along one direction, at most
  for (const JointEstimate& e : fit.joints) {
    const bool radius = e.parameter.name.find("pivot_radius") != std::string::npos,
               angle = e.parameter.name.find("pivot_angle") != std::string::npos;
    const double error_m = radius ? e.stderr_value : angle ? 0.25 * e.stderr_value : 0.0;
    variance = std::max(variance, error_m * error_m);
    if (e.parameter.effect == "pivot_angle_bias") offset_error_rad = std::max(offset_error_rad, e.stderr_value);
  }
  const double error_m = std::sqrt(2.0 * variance);
  const auto apart_m = [](const std::vector<Castor>& castors, std::size_t k) {
    return length(castors[k].pivot() - castors[(k + 1) % castors.size()].pivot());
  };
  double off_in_file_m = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double actual_m = apart_m(actual.castors, k);
    off_in_file_m = std::max(off_in_file_m, std::abs(apart_m(three_castor_vehicle().castors, k) - actual_m));
    EXPECT_NEAR(apart_m(found, k), actual_m, 4.0 * error_m);
    EXPECT_NEAR(found[k].pivot_encoder_offset_rad, 0.0, 4.0 * offset_error_rad);
  }
  EXPECT_LT(4.0 * error_m, off_in_file_m);
}

}  // namespace
}  // namespace odolab::test
