#include "core/diagnosis/units/traces.h"

#include <gtest/gtest.h>

#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// What has no name and predicts nothing is a trace of joints that are rounded, where it is small; but dead reckoning
// that is off by three times its noise is off, and "nothing is missing" is no answer.
TEST(LeaveOutTraces, TakesOnlyForATraceWhatLeavesLittle) {
  for (const double off : {1.3, 3.0}) {
    Diagnosis d;
    d.verdict = Verdict::unknown_effect;
    Finding f;
    f.effect = "unknown";
    f.component = "vehicle";
    f.log_likelihood_gain = 800.0;
    d.findings = {f};
    FitFigures floor, calibrated;
    floor.position_rms_m = 0.01, floor.heading_rms_rad = 0.01;
    calibrated.position_rms_m = off * floor.position_rms_m, calibrated.heading_rms_rad = off * floor.heading_rms_rad;
    d.held_out.calibrated = d.held_out.with_findings = d.held_out.spline = calibrated;
    d.held_out.noise_floor = floor;
    leave_out_traces(d, false);
    EXPECT_EQ(d.verdict == Verdict::unknown_effect, off > 2.0) << off;
  }
}

// A wheel that is out of round shows beside the trace of its joint, which goes where that name stands.
TEST(LeaveOutTraces, IsNotDoneWhereANameExplainsMostOfThem) {
  const auto is_kept = [](double gain, double of_its_name, double times_the_noise, bool castor) {
    Diagnosis d;
    d.held_out.noise_floor = FitFigures{0.008, 0.010, 1.0};
    d.held_out.calibrated = FitFigures{0.008, 0.010 * times_the_noise, 1.4};
    d.held_out.spline = d.held_out.calibrated;
    Finding f;
    f.effect = "unknown";
    f.component = "vehicle";
    f.log_likelihood_gain = gain;
    f.alternatives = {{"wheel_eccentricity", "left_wheel", of_its_name, ""}};
    d.findings = {f};
    return has_a_name_beside_a_trace(d, castor);
  };
  EXPECT_TRUE(is_kept(88.0, 64.0, 1.2, false));
  EXPECT_FALSE(is_kept(88.0, 40.0, 1.2, false));  // less than half of it
  EXPECT_FALSE(is_kept(28.0, 24.0, 1.2, false));  // hardly any evidence
  EXPECT_FALSE(is_kept(88.0, 64.0, 2.5, false));  // too large for a trace
  EXPECT_FALSE(is_kept(88.0, 64.0, 1.2, true));   // castors on a frame make as much
}

TEST(RoundingFromInside, HidesAPushThatOneCountOfTheOtherTruckMakesThroughTheLink) {
  const Clapper trucks = fine_clapper();  // 0.24 mm a count, 0.7 mrad of its truck, 0.7 mm at the far end of a metre
  const Vehicle vehicle = vehicle_of(trucks);
  const JointRounding rounding = rounding_from_inside(vehicle);
  const VehicleUnit b = units_of(vehicle)[1];
  Finding push;
  push.effect = "collision";
  push.parameters = {
      {"dx_m", 0.0011, 0.0002, "m"}, {"dy_m", 0.0010, 0.0002, "m"}, {"dheading_rad", -0.0015, 3e-4, "rad"}};
  EXPECT_TRUE(may_be_rounding(push, b, rounding));
  push.parameters[2].value = -0.006;
  EXPECT_FALSE(may_be_rounding(push, b, rounding));
  Finding bump;
  bump.effect = "bump";
  bump.parameters = {{"extra_distance_m", 0.0009, 0.0001, "m"}};
  EXPECT_TRUE(may_be_rounding(bump, b, rounding));
  bump.parameters[0].value = 0.004;
  EXPECT_FALSE(may_be_rounding(bump, b, rounding));
}

}  // namespace
}  // namespace odolab::test
