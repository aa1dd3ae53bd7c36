// Linked and castor vehicles of whose truth there are the poses at both ends of a run alone, or none.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/together/joined_model.h"
#include "test/support/known_lengths.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// Put down with a tape: five millimetres.
LinkedRunSettings under_a_tape() {
  LinkedRunSettings s;
  s.duration_s = 60.0;
  s.truth_m = s.truth_rad = 0.005;
  return s;
}

Recording ends_of(Recording r) {
  for (Channel& c : r.channels)
    if (c.name.rfind("truth_", 0) == 0)
      for (std::size_t i = 1; i + 1 < c.values.size(); ++i) c.values[i] = std::numeric_limits<double>::quiet_NaN();
  return r;
}

// The same way, and back again as it came.
Recording with_way_back(Recording r) {
  const std::size_t there = r.time_s.size();
  for (std::size_t i = there - 1; i-- > 0;) {
    r.time_s.push_back(2.0 * r.time_s[there - 1] - r.time_s[i]);
    for (Channel& c : r.channels) c.values.push_back(c.values[i]);
  }
  return r;
}

TEST(DiagnoseUnits, MeasureHowLargeAllWheelsAreByTheEndsOfTheirWays) {
  const Clapper actual = larger(fine_clapper(), 0.01);
  const LinkedRunSettings s = under_a_tape();
  std::vector<Recording> runs;
  for (std::uint64_t seed = 500; seed < 505; ++seed) runs.push_back(ends_of(linked_run(actual, s, seed)));
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(fine_clapper()));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  EXPECT_FALSE(d->calibration.scale_is_open);
  expect_known(*d, "truck_a.wheel_radius_left_m", actual.truck_a.wheel_radius_left_m, 0.002);
  expect_known(*d, "truck_a.wheelbase_m", actual.truck_a.wheelbase_m, 0.005);
  expect_known(*d, "truck_b.wheel_radius_right_m", actual.truck_b.wheel_radius_right_m, 0.002);
  expect_known(*d, "truck_b.wheelbase_m", actual.truck_b.wheelbase_m, 0.005);
}

double mean_radius_m(const Vehicle& vehicle) {
  double sum_m = 0.0;
  for (const VehicleUnit& u : units_of(vehicle)) sum_m += u.drive.wheel_radius_left_m + u.drive.wheel_radius_right_m;
  return 0.5 * sum_m / static_cast<double>(units_of(vehicle).size());
}

// Three runs say nine numbers of how large the trucks are, of where the tracked point sits and of how much they err.
TEST(JoinedModel, KnowsHowLargeAllUnitsAreToWithinItsStandardErrorsByThreeEnds) {
  constexpr int kSets = 14, kRuns = 3;
  constexpr double kChiSquare99 =
      29.1;  // of as many; they had made 32.7 with what was left of the ends for their error
  const Clapper actual = larger(fine_clapper(), 0.01);
  const Vehicle file = vehicle_of(fine_clapper());
  double squares = 0.0;
  for (int set = 0; set < kSets; ++set) {
    std::vector<JoinedRun> runs;
    for (int k = 0; k < kRuns; ++k) {
      const Recording r =
          ends_of(linked_run(actual, under_a_tape(), static_cast<std::uint64_t>(500 + kRuns * set + k)));
      runs.push_back({unit_samples(r, file), tracked_poses(r)});
    }
    JoinedModel model(runs, file, {}, {"a", "b", "c"});
    model.fit_all();
    const double off = mean_radius_m(model.vehicle()) / mean_radius_m(vehicle_of(actual)) - 1.0;
    squares += std::pow(off / model.stderr_of_scale(), 2);
  }
  EXPECT_LT(squares, kChiSquare99);
}

Recording with_tracked_point_at(Recording r, const Pose& axle_T_tracked) {
  const std::size_t n = r.channels.size();
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    const auto of = [&](std::size_t back) -> double& { return r.channels[n - back].values[i]; };
    const Pose tracked = Pose{of(3), of(2), of(1)} * axle_T_tracked;
    of(3) = tracked.x_m, of(2) = tracked.y_m, of(1) = tracked.heading_rad;
  }
  return r;
}

// The file has it on the axle: that it is elsewhere had made a CLAPPER of another program 0.43 % too small, nine
// standard errors, and its link 3.5 mm too long.
TEST(DiagnoseUnits, MeasureByTheEndsOfTheirWaysWhereTheTrackedPointSits) {
  const Pose axle_T_tracked{-0.02, 0.03, 0.025};
  const Clapper actual = larger(fine_clapper(), 0.01);
  std::vector<Recording> runs;
  for (std::uint64_t seed = 514; seed < 519; ++seed)
    runs.push_back(with_tracked_point_at(ends_of(linked_run(actual, under_a_tape(), seed)), axle_T_tracked));
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(fine_clapper()));
  ASSERT_TRUE(d);
  ASSERT_EQ(d->findings.size(), 1u);
  EXPECT_EQ(d->findings[0].effect, "truth_mounting_offset");
  EXPECT_DOUBLE_EQ(d->fitted_vehicle->truth.axle_T_tracked.y_m, d->findings[0].parameters[1].value);
  for (const NotTestable& n : d->not_testable) EXPECT_NE(n.effect, "truth_mounting_offset");
  expect_known(*d, "truck_a.wheel_radius_left_m", actual.truck_a.wheel_radius_left_m, 0.003);
  expect_known(*d, "truck_b.wheel_radius_right_m", actual.truck_b.wheel_radius_right_m, 0.003);
  expect_known(*d, "truth_mounting.y_m", axle_T_tracked.y_m, 0.3);
  expect_known(*d, "truth_mounting.heading_rad", axle_T_tracked.heading_rad, 0.3);
}

TEST(DiagnoseUnits, KnowRatiosAloneWhereTheWayEndsAtItsBeginning) {
  const Clapper trucks = fine_clapper();
  const LinkedRunSettings s = under_a_tape();
  const Result<Diagnosis> d =
      diagnose({ends_of(with_way_back(linked_run(trucks, s, 521))), ends_of(with_way_back(linked_run(trucks, s, 522)))},
               {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->calibration.scale_is_open);
}

// A trailer of unequal wheels, which the file does not know of, by the poses of what tows it.
Result<Diagnosis> of_trailer_by_ends(const EncoderTrailer& actual, std::uint64_t seed) {
  std::vector<Recording> runs;
  for (std::uint64_t run = 0; run < 10; ++run) runs.push_back(ends_of(trailer_run(actual, under_a_tape(), seed + run)));
  EncoderTrailer file;
  file.hitch_angle_resolution_rad = actual.hitch_angle_resolution_rad;
  return diagnose(runs, {}, vehicle_of(file));
}

EncoderTrailer with_unequal_wheels() {
  EncoderTrailer actual;
  actual.hitch_angle_resolution_rad = 0.0005;
  actual.trailer.wheel_radius_left_m *= 1.004;
  actual.trailer.wheel_radius_right_m *= 0.996;
  return actual;
}

// The towing vehicle's own wheels are not looked at: its poses and the hitch put the trailer's axle.
TEST(DiagnoseUnits, MeasureATrailerByTheEndsOfItsWays) {
  const EncoderTrailer actual = with_unequal_wheels();
  const Result<Diagnosis> d = of_trailer_by_ends(actual, 531);
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->findings.empty());
  expect_known(*d, "trailer.wheel_radius_left_m", actual.trailer.wheel_radius_left_m, 0.008);
  expect_known(*d, "trailer.wheel_radius_right_m", actual.trailer.wheel_radius_right_m, 0.008);
  expect_known(*d, "trailer.wheelbase_m", actual.trailer.wheelbase_m, 0.008);
}

// Radii that are not known each, held as in the file, had put their difference on the wheelbase: 8 mm.
TEST(DiagnoseUnits, KeepWhatTwoWheelsDifferByOutOfTheWheelbaseWhereTheirMeanDoesNotShow) {
  const EncoderTrailer actual = with_unequal_wheels();
  const Result<Diagnosis> d = of_trailer_by_ends(actual, 620);
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->calibration.scale_is_open);
  expect_known(*d, "trailer.wheel_radius_left_m", actual.trailer.wheel_radius_left_m, 0.001);
  expect_known(*d, "trailer.wheel_radius_right_m", actual.trailer.wheel_radius_right_m, 0.001);
  expect_known(*d, "trailer.wheelbase_m", actual.trailer.wheelbase_m, 0.005);
}

// Stamped a third of a second before the encoders, which stand, and after them; a second is another way.
TEST(FewPoses, AreThoseOfTheFirstAndTheLastReadingWhereTheVehicleStands) {
  const std::vector<UnitSample> samples = {{1.0, {}, {}}, {2.0, {}, {}}, {3.0, {}, {}}};
  constexpr double kLate_s = 0.1;
  const Track at = few_poses({{0.1, {}}, {0.7, {}}, {2.1, {}}, {3.5, {}}}, samples, kLate_s);
  EXPECT_EQ(at[0].time_s, 0.1);
  EXPECT_EQ(at[1].time_s, 1.0 + kLate_s);
  EXPECT_EQ(at[2].time_s, 2.1);
  EXPECT_EQ(at[3].time_s, 3.0 + kLate_s);
}

// A sixth of a step of the link's encoder, at every sample of three runs.
TEST(DiagnoseUnits, NameABiasOfASmallPartOfAMilliradianThatTheTrucksTellEachOther) {
  constexpr double kBias_rad = 0.0008;
  const Clapper file = fine_clapper();
  Clapper actual = file;
  actual.link_angle_b_offset_rad = kBias_rad;
  LinkedRunSettings s = under_a_tape();
  s.wheel_noise = 1e-4;
  std::vector<Recording> runs = {linked_run(actual, s, 541), linked_run(actual, s, 542), linked_run(actual, s, 543)};
  for (Recording& r : runs) r.channels.resize(r.channels.size() - 3);
  ASSERT_TRUE(truth_samples(runs[0]).empty());
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(file));
  ASSERT_TRUE(d);
  ASSERT_EQ(d->findings.size(), 1u);
  EXPECT_EQ(d->findings[0].effect, "link_angle_bias");
  EXPECT_EQ(d->findings[0].component, "truck_b");
  const FoundParameter& bias = d->findings[0].parameters[0];
  EXPECT_NEAR(bias.value, kBias_rad, 3.5 * bias.stderr_value);
}

}  // namespace
}  // namespace odolab::test
