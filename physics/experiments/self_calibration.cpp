// UMBmark report, section 7.3: the automated self-calibration that it announces, and what it reaches.
#include "physics/self_calibration.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/io/number_text.h"
#include "physics/experiments/experiment.h"
#include "physics/experiments/report_labmates.h"
#include "physics/experiments/spread.h"

namespace odolab {

namespace {

constexpr int kSelfCalibratingRobots = 8;
constexpr int kSelfJudgedEachWay = 10;
constexpr double kLargestScaleError = 0.005;  // "0.3-0.5 % of full scale" (section 2.3)

// LabMates as in Table III that also roll further or less far than their drawing says.
std::vector<Scenario> robots_to_calibrate(int count, std::uint64_t seed) {
  std::vector<Scenario> robots = labmates_of_table3(count, seed);
  Random random(seed_of_stream(seed, 1));
  for (Scenario& robot : robots) {
    const double scale = 1.0 + random.uniform(-kLargestScaleError, kLargestScaleError);
    robot.actual.wheel_radius_left_m *= scale;
    robot.actual.wheel_radius_right_m *= scale;
  }
  return robots;
}

Result<ExperimentReport> run_self_calibrations(const ExperimentOptions& options, const Progress& progress) {
  const int count = options.cases > 0 ? options.cases : kSelfCalibratingRobots;
  const std::vector<Scenario> robots = robots_to_calibrate(count, seed_of_stream(options.seed, 5));
  const SelfCalibrationPlan plan;
  std::vector<std::optional<SelfCalibration>> done(robots.size());
  const int finished = parallel_for(
      count,
      [&](int i, const std::atomic<bool>& stopped) {
        done[static_cast<std::size_t>(i)] = self_calibrate(
            robots[static_cast<std::size_t>(i)], plan, seed_of_stream(options.seed, 50 + static_cast<std::uint64_t>(i)),
            [&stopped](double) { return !stopped; });
      },
      {}, [&](double share) { return goes_on(progress, 0.6 * share); });
  ExperimentReport report;
  if (finished < count) return report;  // stopped

  std::vector<double> before, after, diameter, wheelbase, scale, driven, duration, farthest;
  ResultTable table{"each robot, Emax,syst in mm; errors of what it found in parts per million",
                    {"#", "before", "rounds", "judged", "Ed error (stated)", "Eb error (stated)", "scale error"},
                    {}};
  const double floor_share = travelled_per_rolled_on_report_floor();
  double least_fold = 1e9;
  int lost = 0, held = 0, stated = 0, only_scatter = 0;
  for (int i = 0; i < count; ++i) {
    const Scenario& robot = robots[static_cast<std::size_t>(i)];
    const SelfCalibration& self = *done[static_cast<std::size_t>(i)];
    if (self.lost) {
      ++lost;
      continue;
    }
    Scenario again = robot;
    again.vehicle.kind = self.found;
    again.benchmark->runs_each_way = kSelfJudgedEachWay;
    const UmbmarkRuns runs =
        run_umbmark(again, seed_of_stream(options.seed, 500 + static_cast<std::uint64_t>(i)), {},
                    [&](double share) { return goes_on(progress, 0.6 + 0.4 * (i + share) / count); });
    if (static_cast<int>(runs.counter_clockwise.size()) < kSelfJudgedEachWay) return ExperimentReport{};  // stopped
    const double before_m = self.rounds.front().measure.largest_systematic_error_m;
    const double after_m = measure_umbmark(runs)->largest_systematic_error_m;
    const ActualDrive& a = robot.actual;
    const DifferentialDrive& f = self.found;
    const double diameter_error =
        f.wheel_radius_right_m / f.wheel_radius_left_m / (a.wheel_radius_right_m / a.wheel_radius_left_m) - 1.0;
    const double scale_error = (f.wheel_radius_right_m + f.wheel_radius_left_m) /
                                   (a.wheel_radius_right_m + a.wheel_radius_left_m) / floor_share -
                               1.0;
    const double wheelbase_error = f.wheelbase_m / a.wheelbase_m - 1.0;
    const UmbmarkCalibration* last = nullptr;
    for (const SelfCalibrationRound& round : self.rounds)
      if (round.calibration) last = &*round.calibration;
    // Squares know the wheelbase in wheels; in metres the tape's error joins in.
    const double wheelbase_stderr = std::hypot(last->wheelbase_ratio_stderr, self.scale->scaling_error_stderr);
    for (const auto& [error, stderr_of] :
         {std::pair{diameter_error, last->wheel_diameter_ratio_stderr}, std::pair{wheelbase_error, wheelbase_stderr}}) {
      ++stated;
      held += std::abs(error) < 1.96 * stderr_of;
    }
    before.push_back(mm(before_m));
    after.push_back(mm(after_m));
    diameter.push_back(1e6 * diameter_error);
    wheelbase.push_back(1e6 * wheelbase_error);
    scale.push_back(100.0 * scale_error);
    driven.push_back(self.driven_m);
    duration.push_back(self.duration_s / 60.0);
    farthest.push_back(self.farthest_from_corner_m);
    only_scatter += after_m < 3.0 * self.rounds.back().measure.standard_error_m;
    least_fold = std::min(least_fold, before_m / after_m);
    const auto ppm = [](double error, double stderr_of) {
      return number_text("%.0f", 1e6 * error) + " (" + number_text("%.0f", 1e6 * stderr_of) + ")";
    };
    table.rows.push_back({std::to_string(i + 1), number_text("%.0f", mm(before_m)), std::to_string(self.rounds.size()),
                          number_text("%.0f", mm(after_m)), ppm(diameter_error, last->wheel_diameter_ratio_stderr),
                          ppm(wheelbase_error, wheelbase_stderr), number_text("%.0f", 1e6 * scale_error)});
  }
  goes_on(progress, 1.0);
  report.figures = {
      figure_of("Emax,syst before", "mm", before),
      figure_of("Emax,syst after, judged on ten more squares each way", "mm", after),
      figure_of("error of the ratio of wheel diameters", "ppm", diameter),
      figure_of("error of the wheelbase", "ppm", wheelbase),
      figure_of("error of the scale, from one reading of a tape", "%", scale),
      figure_of("driven for it", "m", driven),
      figure_of("time taken", "min", duration),
      figure_of("farthest from its corner when it measured itself", "m", farthest),
  };
  report.tables = {table};
  report.claims = {
      {.sentence = "every robot comes home by itself between its squares, and leaves no more than their scatter hides "
                   "(3 SEM)",
       .holds = lost == 0 && 20 * only_scatter >= 19 * count - 20,  // 95 %, and one more
       .because = std::to_string(lost) + " of " + std::to_string(count) + " lost; within 3 SEM " +
                  std::to_string(only_scatter) + "; the least improvement is " + number_text("%.1f", least_fold) +
                  "-fold"},
      {.sentence = "what it states about its own uncertainty is true (95 % of the errors within 1.96 standard errors)",
       .holds =
           held >= stated - 1 - stated / 8,  // of 16 at least 13: fewer happens to a true statement in 1 % of cases
       .because = std::to_string(held) + " of " + std::to_string(stated) +
                  " within; a true statement has fewer than 13 of 16 in one case of a hundred"},
  };
  report.notes = {"on this floor a wheel travels " + number_text("%.2f", 100.0 * (1.0 - floor_share)) +
                  " % less than it rolls; the tape is read on the same floor, so that the scale found holds there, and "
                  "the error of the scale is judged against it"};
  report.assumptions = {
      report_floor_assumption(),
      "wheels up to 0.5 % larger or smaller than drawn in the mean; a tape reading of 2 mm over 4 m; 0.5 m of straight "
      "approach before each square",
      "the sonar corner is read (2 mm, 0.4 degrees) wherever the robot stops between two squares",
  };
  return report;
}

}  // namespace

Experiment self_calibration() {
  return {"self-calibration", "a LabMate calibrates itself in a sonar corner; a person only reads a tape once",
          "UMBmark report, section 7.3 (announced there, without figures)", run_self_calibrations};
}

}  // namespace odolab
