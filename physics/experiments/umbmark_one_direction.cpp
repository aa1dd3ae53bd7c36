// UMBmark report, sections 3.1 and 3.2: why the square in one direction deceives.
#include "core/geometry/angles.h"
#include "core/io/number_text.h"
#include "physics/benchmark.h"
#include "physics/experiments/experiment.h"

namespace odolab {

namespace {

// The report's example: each nominally straight leg curves by 3 degrees, and each turn is 87 degrees instead of 90.
constexpr double kLegCurve_deg = 3.0;
constexpr double kTurn_deg = 87.0;

Scenario deceiving_robot() {
  Scenario scenario;
  const DifferentialDrive nominal = std::get<DifferentialDrive>(scenario.vehicle.kind);
  scenario.actual = as_drawn(nominal);
  const double side_m = std::get<SquarePath>(scenario.path).side_m;
  const double curvature_radius_m = side_m / radians(kLegCurve_deg);  // Eq. 6.23, the side being the arc
  scenario.actual.wheelbase_m = nominal.wheelbase_m * 90.0 / kTurn_deg;
  const double half_difference = 0.5 * scenario.actual.wheelbase_m / curvature_radius_m;  // from Eq. 6.24
  scenario.actual.wheel_radius_left_m *= 1.0 - half_difference;                           // legs curve to the left
  scenario.actual.wheel_radius_right_m *= 1.0 + half_difference;
  scenario.sensors.truth_position_noise_m = 0.002;  // the sonar corner, section 6.3
  scenario.sensors.truth_heading_noise_rad = radians(0.4);
  return scenario;
}

Result<ExperimentReport> run_umbmark_one_direction(const ExperimentOptions& options, const Progress& progress) {
  const std::vector<UmbmarkStage> stages = run_umbmark_calibration(deceiving_robot(), options.seed, {}, progress);
  ExperimentReport report;
  if (stages.size() < 2) return report;  // stopped
  const UmbmarkMeasure& before = stages.front().measure;
  const UmbmarkMeasure& after = stages.back().measure;
  report.figures = {
      {.name = "return error counter-clockwise", .unit = "mm", .ours = mm(before.counter_clockwise.distance_m)},
      {.name = "return error clockwise", .unit = "mm", .ours = mm(before.clockwise.distance_m)},
      {.name = "Emax,syst after calibration in both directions",
       .unit = "mm",
       .ours = mm(after.largest_systematic_error_m)},
  };
  const double factor = before.clockwise.distance_m / before.counter_clockwise.distance_m;
  report.claims = {
      {.sentence = "two errors that cancel in one direction add in the other (Figs. 3.2, 3.3)",
       .holds = factor > 10.0,
       .because = "the other direction's error is " + number_text("%.0f", factor) + " times as large"},
      {.sentence = "the square in both directions finds both errors",
       .holds = after.largest_systematic_error_m < 0.1 * before.largest_systematic_error_m,
       .because = "Emax,syst falls from " + number_text("%.0f", mm(before.largest_systematic_error_m)) + " to " +
                  number_text("%.1f", mm(after.largest_systematic_error_m)) + " mm"},
  };
  report.assumptions = {"floor without roughness; LabMate of 340 mm wheelbase, 0.2 m/s"};
  return report;
}

}  // namespace

Experiment umbmark_one_direction() {
  return {"umbmark-one-direction", "two errors that cancel in one direction and add in the other",
          "UMBmark report, sections 3.1 and 3.2", run_umbmark_one_direction};
}

}  // namespace odolab
