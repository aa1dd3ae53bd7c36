// UMBmark report, section 6.3 and Table III: eight calibrations of LabMates, and experiment 7's second compensation.
#include <algorithm>

#include "core/base/random.h"
#include "core/io/number_text.h"
#include "physics/benchmark.h"
#include "physics/experiments/experiment.h"
#include "physics/experiments/report_labmates.h"
#include "physics/experiments/spread.h"

namespace odolab {

namespace {

constexpr int kRobots = 8;
constexpr int kJudgedEachWay = 10;  // Emax,syst after calibration is small against the scatter of five runs
constexpr int kSettlingTapes = 4;
constexpr double kBefore7_m = 0.423, kAfterFirst7_m = 0.066;

std::string text_mm(double m) { return number_text("%.0f", mm(m)); }

// What the report's first-order formulas would leave, beside the exact path's: only their difference matters.
double left_by_first_order_m(const UmbmarkCalibration& c) {
  return first_order_largest_error_m({c.printed.alpha_rad - c.exact.alpha_rad, c.printed.beta_rad - c.exact.beta_rad});
}

struct Calibrated {
  std::vector<UmbmarkStage> stages;
  UmbmarkMeasure judged;  // ten more squares each way with the last calibration
  double before_m() const { return stages.front().measure.largest_systematic_error_m; }
  double first_m() const { return stages[1].measure.largest_systematic_error_m; }
  double after_m() const { return stages.back().measure.largest_systematic_error_m; }
};

std::optional<Calibrated> calibrated(const Scenario& robot, std::uint64_t seed, const Progress& progress) {
  Calibrated result;
  result.stages =
      run_umbmark_calibration(robot, seed, {}, [&](double share) { return goes_on(progress, 0.7 * share); });
  if (result.stages.size() < 2) return std::nullopt;
  Scenario again = robot;
  again.vehicle.kind = result.stages.back().nominal;
  again.benchmark->runs_each_way = kJudgedEachWay;
  const UmbmarkRuns runs = run_umbmark(again, seed_of_stream(seed, 77), {},
                                       [&](double share) { return goes_on(progress, 0.7 + 0.3 * share); });
  if (static_cast<int>(runs.counter_clockwise.size()) < kJudgedEachWay) return std::nullopt;
  result.judged = *measure_umbmark(runs);
  return result;
}

// Experiment 7 had tape around its right wheel. Here the tape settles after the first five squares, by as much as makes
// 66 mm by Eqs. 6.19 to 6.24; what the second compensation then reaches is not put in.
struct SettledTape {
  UmbmarkMeasure before, after_first, after_second;
  double settled_m = 0.0;  // of the diameter
};

std::optional<SettledTape> with_settling_tape(std::uint64_t seed, const Progress& progress) {
  const double beta_rad = kBefore7_m / first_order_largest_error_m({0.0, 1.0});
  const double ratio_per_beta = 0.340 / kReportSide_m;
  Scenario robot = labmate_on_report_squares(1.0 + beta_rad * ratio_per_beta, 1.0);
  SettledTape result;
  for (std::uint64_t k = 0; k < 3; ++k) {
    const UmbmarkRuns runs = run_umbmark(robot, seed_of_stream(seed, k), {}, [&](double share) {
      return goes_on(progress, (static_cast<double>(k) + share) / 3.0);
    });
    if (static_cast<int>(runs.counter_clockwise.size()) < robot.benchmark->runs_each_way) return std::nullopt;
    (k == 0 ? result.before : k == 1 ? result.after_first : result.after_second) = *measure_umbmark(runs);
    robot.vehicle.kind = calibrate_umbmark(runs, std::get<DifferentialDrive>(robot.vehicle.kind))->corrected;
    if (k > 0) continue;
    const double settles = kAfterFirst7_m / first_order_largest_error_m({0.0, 1.0}) * ratio_per_beta;
    result.settled_m = 2.0 * robot.actual.wheel_radius_right_m * settles;
    robot.actual.wheel_radius_right_m *= 1.0 - settles;
  }
  return result;
}

Result<ExperimentReport> run_umbmark_table3(const ExperimentOptions& options, const Progress& progress) {
  const int count = options.cases > 0 ? options.cases : kRobots;
  const std::vector<Scenario> robots = labmates_of_table3(count, seed_of_stream(options.seed, 3));
  ExperimentReport report;
  std::vector<double> before, first, after, judged, fold;
  ResultTable table{std::to_string(count) + " robots, Emax,syst in mm",
                    {"#", "Ed", "Eb", "before", "first", "second", "judged", "improvement", "first order leaves"},
                    {}};
  double least_fold = 1e9, largest_first_order_m = 0.0, largest_first_m = 0.0;
  int second_compensations = 0, within_rule = 0;
  bool only_scatter_is_left = true;
  std::uint64_t seed = options.seed;
  for (int i = 0; i < count; ++i) {
    const auto c =
        calibrated(robots[static_cast<std::size_t>(i)], seed_of_stream(seed, 100 + static_cast<std::uint64_t>(i)),
                   [&](double share) { return goes_on(progress, (i + share) / (count + 1)); });
    if (!c) return report;  // stopped
    const double f = c->before_m() / c->judged.largest_systematic_error_m;
    before.push_back(mm(c->before_m()));
    first.push_back(mm(c->first_m()));
    after.push_back(mm(c->after_m()));
    judged.push_back(mm(c->judged.largest_systematic_error_m));
    fold.push_back(f);
    least_fold = std::min(least_fold, f);
    largest_first_m = std::max(largest_first_m, c->first_m());
    second_compensations += c->stages.size() > 2;
    const UmbmarkMeasure& last = c->stages.back().measure;
    within_rule += !last.worth_compensating;
    if (f < 10.0 && c->judged.largest_systematic_error_m > 3.0 * last.standard_error_m) only_scatter_is_left = false;
    const double first_order_m = left_by_first_order_m(*c->stages.front().calibration);
    largest_first_order_m = std::max(largest_first_order_m, first_order_m);
    const ActualDrive& a = robots[static_cast<std::size_t>(i)].actual;
    table.rows.push_back({std::to_string(i + 1), number_text("%.4f", a.wheel_radius_right_m / a.wheel_radius_left_m),
                          number_text("%.4f", a.wheelbase_m / 0.340), text_mm(c->before_m()), text_mm(c->first_m()),
                          c->stages.size() > 2 ? text_mm(c->after_m()) : "",
                          text_mm(c->judged.largest_systematic_error_m), number_text("%.1f", f) + "-fold",
                          text_mm(first_order_m)});
  }
  std::vector<double> before7, first7, second7;
  bool rule_asks = true;
  double settled_m = 0.0;
  for (int i = 0; i < kSettlingTapes; ++i) {
    const auto seven = with_settling_tape(seed_of_stream(seed, 70 + static_cast<std::uint64_t>(i)), [&](double share) {
      return goes_on(progress, (count + (i + share) / kSettlingTapes) / (count + 1));
    });
    if (!seven) return report;  // stopped
    before7.push_back(mm(seven->before.largest_systematic_error_m));
    first7.push_back(mm(seven->after_first.largest_systematic_error_m));
    second7.push_back(mm(seven->after_second.largest_systematic_error_m));
    rule_asks = rule_asks && seven->after_first.worth_compensating;
    settled_m = seven->settled_m;
  }
  goes_on(progress, 1.0);
  const double before_mm = mean_and_spread(before7).mean, first_mm = mean_and_spread(first7).mean,
               second_mm = mean_and_spread(second7).mean;

  report.figures = {
      figure_of("Emax,syst before", "mm", before, 232, 423),
      figure_of("Emax,syst after, measured on five squares each way", "mm", after, 12, 35),
      figure_of("Emax,syst after, judged on ten more each way", "mm", judged),
      figure_of("improvement, judged so", "1", fold, 10, 22),
      figure_of("experiment 7 made by a settling tape: after the first compensation", "mm", first7),
      figure_of("experiment 7 made by a settling tape: after the second compensation", "mm", second7, 20),
  };
  report.tables = {table};
  report.claims = {
      {.sentence = "each calibration improves Emax,syst at least tenfold (Table III)",
       .holds = least_fold >= 10.0,
       .because = "the least improvement is " + number_text("%.1f", least_fold) +
                  "-fold; what is left lies within 3 SEM of five squares in " + std::to_string(within_rule) + " of " +
                  std::to_string(count),
       .explained = only_scatter_is_left},
      {.sentence = "one calibration of eight leaves 66 mm by chance (experiment 7)",
       .holds = largest_first_m > 0.060,
       .because =
           "the most that a first compensation leaves here is " + text_mm(largest_first_m) +
           " mm, and the report's first-order formulas would leave " + text_mm(largest_first_order_m) +
           " mm more at most. So something changed between the two sets of squares, which the report does not name. "
           "The figures of experiment 7 above are made by an input, not found: a tape that settles by " +
           number_text("%.0f", 1e6 * settled_m) + " micrometres, chosen for 66 mm, leaves " +
           number_text("%.0f", first_mm) + " mm",
       .explained = true},
      {.sentence = "a second compensation where the rule of 3 SEM asks for one improves on the first (section 6.3)",
       .holds = rule_asks && second_mm < 0.5 * first_mm,
       .because = "with the tape that settles " + number_text("%.0f", before_mm) + ", " +
                  number_text("%.0f", first_mm) + ", " + number_text("%.0f", second_mm) + " mm; among the " +
                  std::to_string(count) + " robots the rule asked for it " + std::to_string(second_compensations) +
                  " times"},
  };
  report.assumptions = {
      report_floor_assumption(),
      "up to 0.3 % between the wheels and 1 % in the wheelbase, drawn so that the first-order formulas give an "
      "Emax,syst of 232 to 423 mm; on this floor it scatters about that",
      "experiment 7's tape settles after the first squares, by what makes the report's 66 mm by Eqs. 6.19 to 6.24: an "
      "input, put in to see what the second compensation does; the report does not say what was different",
  };
  report.notes = {
      "five squares each way that scatter by 25 mm fix a centre of gravity to 11 mm (SEM), so 12 and 35 mm, 10- and "
      "22-fold, are the same result within the scatter, as the report says of its experiments 3 to 5"};
  return report;
}

}  // namespace

Experiment umbmark_table3() {
  return {"umbmark-table3", "eight calibrations of LabMates, and a second compensation",
          "UMBmark report, section 6.3, Table III", run_umbmark_table3};
}

}  // namespace odolab
