// CLAPPER paper, section 6.2: a rectangle of 7 x 4 m in both directions, ten bumps under one side.
#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/io/number_text.h"
#include "core/odometry/ipec.h"
#include "physics/experiments/clapper_runs.h"
#include "physics/experiments/spread.h"

namespace odolab {

namespace {

constexpr double kRectangleLength_m = 7.0, kRectangleWidth_m = 4.0, kRectangleCorner_m = 0.45;

enum RectangleCondition { kCorrectedWithBumps, kCorrectedWithout, kPlainWithBumps, kRectangleConditions };
const char* const kRectangleNames[kRectangleConditions] = {"with IPEC, ten bumps", "with IPEC, without bumps",
                                                           "without IPEC, ten bumps"};

// Three on each long side, two on each short one, a metre and more from the corners.
Floor with_bumps_on_sides(Floor floor, bool clockwise, Under under) {
  const double turn = clockwise ? -1.0 : 1.0;
  Pose side;  // begins where the last corner's arc ends
  for (int k = 0; k < 4; ++k) {
    const double straight_m = (k % 2 == 0 ? kRectangleLength_m : kRectangleWidth_m) - 2.0 * kRectangleCorner_m;
    const int count = k % 2 == 0 ? 3 : 2;
    for (int i = 0; i < count; ++i) {
      Bump bump;
      bump.centre = side * Vec2{straight_m * (i + 1.5) / (count + 1.0), 0.0};
      bump.length_m = 2.0;
      bump.under = under;
      bump.round = true;
      floor.bumps.push_back(bump);
    }
    side = side * Pose{straight_m + kRectangleCorner_m, turn * kRectangleCorner_m, turn * 0.5 * kPi};
  }
  return floor;
}

struct RectangleRun {
  ReturnPose by_driving;
  double true_heading_deg = 0.0;  // the same heading error without the sonar's noise
  double by_rule_deg[3] = {};     // of other estimators on the same recording
};

RectangleRun drive_rectangle(RectangleCondition condition, int number, std::uint64_t seed) {
  const bool clockwise = number % 2 == 0;
  Scenario scenario =
      report_clapper(RectanglePath{kRectangleLength_m, kRectangleWidth_m, kRectangleCorner_m, clockwise},
                     condition != kPlainWithBumps);
  // The path starts under the link's centre, half a metre behind truck A.
  scenario.start = {0.5, 0.0, 0.0};
  if (condition != kCorrectedWithout)
    scenario.floor =
        with_bumps_on_sides(scenario.floor, clockwise, number / 2 % 2 == 0 ? Under::right_wheel : Under::left_wheel);
  Simulation simulation(scenario, seed);
  RectangleRun result;
  result.by_driving = run_and_return(simulation);
  const SimulationState& end_state = simulation.state();
  result.true_heading_deg =
      degrees(std::abs(wrapped(end_state.true_pose.heading_rad - end_state.estimated_pose.heading_rad)));
  const Clapper& nominal = std::get<Clapper>(scenario.vehicle.kind);
  const std::vector<LinkedSample> samples = linked_samples(simulation.recording());
  const ResolutionRule rules[] = {ResolutionRule::as_printed, ResolutionRule::dead_band,
                                  ResolutionRule::least_correction};
  for (int r = 0; r < 3; ++r) {
    IpecOptions options;
    options.resolution = rules[r];
    const Pose end = ipec(samples, nominal, scenario.start, options).back().a;
    result.by_rule_deg[r] = degrees(std::abs(wrapped(simulation.state().true_pose.heading_rad - end.heading_rad)));
  }
  return result;
}

Result<ExperimentReport> run_clapper_rectangle(const ExperimentOptions& options, const Progress& progress) {
  const int runs = 2 * (options.cases > 0 ? options.cases : 10);  // both directions
  std::vector<RectangleRun> driven(static_cast<std::size_t>(kRectangleConditions * runs));
  const int jobs = static_cast<int>(driven.size());
  const int done = parallel_for(
      jobs,
      [&](int i) {
        driven[static_cast<std::size_t>(i)] =
            drive_rectangle(static_cast<RectangleCondition>(i / runs), i % runs,
                            seed_of_stream(options.seed, static_cast<std::uint64_t>(i)));
      },
      {}, progress);
  ExperimentReport report;
  if (done < jobs) return report;

  std::vector<double> heading_deg[kRectangleConditions], true_deg[kRectangleConditions],
      position_mm[kRectangleConditions], rule_deg[3];
  ResultTable table{
      "Each run", {"condition", "direction", "x [mm]", "y [mm]", "distance [mm]", "heading [degrees]"}, {}};
  double largest_mm = 0.0;
  bool all_arrived = true;
  for (int i = 0; i < jobs; ++i) {
    const RectangleRun& one = driven[static_cast<std::size_t>(i)];
    const int c = i / runs;
    heading_deg[c].push_back(degrees(std::abs(one.by_driving.heading_rad)));
    true_deg[c].push_back(one.true_heading_deg);
    position_mm[c].push_back(1e3 * one.by_driving.position_m());
    all_arrived = all_arrived && one.by_driving.finished;
    if (c == kCorrectedWithBumps) {
      largest_mm = std::max(largest_mm, position_mm[c].back());
      for (int r = 0; r < 3; ++r) rule_deg[r].push_back(one.by_rule_deg[r]);
    }
    table.rows.push_back({kRectangleNames[c], i % 2 == 0 ? "cw" : "ccw", number_text("%.0f", 1e3 * one.by_driving.x_m),
                          number_text("%.0f", 1e3 * one.by_driving.y_m), number_text("%.0f", position_mm[c].back()),
                          number_text("%.2f", degrees(one.by_driving.heading_rad))});
  }
  const double with_deg = mean_and_spread(heading_deg[kCorrectedWithBumps]).mean;
  const double without_deg = mean_and_spread(heading_deg[kPlainWithBumps]).mean;
  const double factor =
      mean_and_spread(true_deg[kPlainWithBumps]).mean / mean_and_spread(true_deg[kCorrectedWithBumps]).mean;
  report.tables = {table,
                   {"Heading error against the true pose, by the rule for the encoders' resolution, ten bumps",
                    {"rule", "mean [degrees]"},
                    {{"Eq. 13 to the letter", number_text("%.2f", mean_and_spread(rule_deg[0]).mean)},
                     {"dead band of one step", number_text("%.2f", mean_and_spread(rule_deg[1]).mean)},
                     {"least correction into the step", number_text("%.2f", mean_and_spread(rule_deg[2]).mean)}}}};
  report.figures = {
      figure_of("return position error with IPEC, ten bumps", "mm", position_mm[kCorrectedWithBumps], 0.0, 50.0),
      figure_of("return position error with IPEC, without bumps", "mm", position_mm[kCorrectedWithout]),
      figure_of("mean heading error with IPEC, ten bumps", "degrees", heading_deg[kCorrectedWithBumps], 0.3),
      figure_of("mean heading error with IPEC, without bumps", "degrees", heading_deg[kCorrectedWithout]),
      figure_of("mean heading error without IPEC, ten bumps", "degrees", heading_deg[kPlainWithBumps]),
      figure_of("the same with IPEC, ten bumps, by the true pose", "degrees", true_deg[kCorrectedWithBumps]),
      {.name = "reduction of the heading error, by the true pose",
       .unit = "times",
       .published_low = 20.0,
       .ours = factor}};
  report.claims = {
      {.sentence = "none of the twenty runs with bumps and IPEC ends more than 5 cm off",
       .holds = all_arrived && largest_mm < 50.0,
       .because = "the largest is " + number_text("%.0f", largest_mm) + " mm"},
      {.sentence = "the mean heading error is 0.3 degrees, about what the sonar can tell",
       .holds = with_deg < 0.4,
       .because = number_text("%.2f", with_deg) + " degrees, the sonar's noise of two readings (0.28) included"},
      {.sentence = "IPEC makes the heading error more than twentyfold smaller",
       .holds = factor > 20.0,
       .because = number_text("%.0f", factor) +
                  " times by the true headings; by the sonar's, whose noise is as large as "
                  "what is left, " +
                  number_text("%.0f", without_deg / with_deg) + " times"},
      {.sentence = "with IPEC, bumps make hardly any difference",
       .holds = with_deg < mean_and_spread(heading_deg[kCorrectedWithout]).mean + 0.15,
       .because = number_text("%.2f", with_deg) + " against " +
                  number_text("%.2f", mean_and_spread(heading_deg[kCorrectedWithout]).mean) + " degrees"},
  };
  report.assumptions = {
      report_clapper_assumptions(), "corners of 0.45 m radius, which pass the corner points at 0.19 m",
      "three cables on each long side and two on each short one, under the wheels of one side of both "
      "trucks; as many runs with them under the left as under the right"};
  return report;
}

}  // namespace

Experiment clapper_rectangle() {
  return {"clapper-rectangle", "7 x 4 m rectangle in both directions over ten bumps",
          "CLAPPER paper (Borenstein 1995), section 6.2", run_clapper_rectangle};
}

}  // namespace odolab
