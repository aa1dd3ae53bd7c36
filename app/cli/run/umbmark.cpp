#include <algorithm>
#include <cmath>

#include "app/cli/run/outputs.h"
#include "app/cli/terminal.h"
#include "core/io/picture/scatter_picture.h"
#include "physics/benchmark.h"

namespace odolab {

namespace {

std::string millimetres(double length_m) { return text_of("%.1f", 1e3 * length_m); }

const char* name_of(std::size_t stage) {
  constexpr const char* kNames[] = {"before calibration", "after calibration", "after a second compensation"};
  return kNames[stage];
}

std::string uncertainty(double stderr_value) { return stderr_value > 0.0 ? text_of(" +- %.5f", stderr_value) : ""; }

void add_calibration(RunOutputs& out, const UmbmarkCalibration& c, const DifferentialDrive& nominal) {
  out.sentences.push_back(text_of(
      "Type A: it turns %.3f degrees too %s in each corner. Type B: it curves %.3f degrees to the %s on each side. "
      "Ed = D_R / D_L = %.5f%s, Eb = b_actual / b_nominal = %.5f%s.",
      degrees(std::abs(c.exact.alpha_rad)), c.exact.alpha_rad > 0.0 ? "little" : "far",
      degrees(std::abs(c.exact.beta_rad)), c.exact.beta_rad > 0.0 ? "left" : "right", c.wheel_diameter_ratio,
      uncertainty(c.wheel_diameter_ratio_stderr).c_str(), c.wheelbase_ratio,
      uncertainty(c.wheelbase_ratio_stderr).c_str()));
  out.sentences.push_back(
      "Squares cannot see a scale common to both wheels: what a rough floor adds to both goes into the wheelbase (Eq. "
      "6.30), "
      "and the uncertainty given is that of the squares alone.");
  if (c.wheel_diameter_ratio_stderr == 0.0)
    out.sentences.push_back("One run in each direction leaves no spread: how uncertain these ratios are is unknown.");
  out.sentences.push_back(
      text_of("Correct the wheelbase from %.2f to %.2f mm, the left wheel's diameter from %.3f to %.3f mm, the right "
              "one's from %.3f to %.3f mm.",
              1e3 * nominal.wheelbase_m, 1e3 * c.corrected.wheelbase_m, 2e3 * nominal.wheel_radius_left_m,
              2e3 * c.corrected.wheel_radius_left_m, 2e3 * nominal.wheel_radius_right_m,
              2e3 * c.corrected.wheel_radius_right_m));
}

Json json_of_stage(const UmbmarkStage& stage) {
  Json json = Json::object();
  json["wheel_radius_left_m"] = stage.nominal.wheel_radius_left_m;
  json["wheel_radius_right_m"] = stage.nominal.wheel_radius_right_m;
  json["wheelbase_m"] = stage.nominal.wheelbase_m;
  json["largest_systematic_error_m"] = stage.measure.largest_systematic_error_m;
  json["spread_m"] = stage.measure.spread_m;
  json["standard_error_m"] = stage.measure.standard_error_m;
  for (const bool clockwise : {true, false}) {
    Json runs = Json::array();
    for (const ReturnError& e : clockwise ? stage.runs.clockwise : stage.runs.counter_clockwise) {
      Json run = Json::object();
      run["x_m"] = e.x_m;
      run["y_m"] = e.y_m;
      run["heading_rad"] = e.heading_rad;
      runs.push_back(run);
    }
    json[clockwise ? "clockwise" : "counter_clockwise"] = runs;
  }
  if (stage.calibration) {
    json["alpha_rad"] = stage.calibration->exact.alpha_rad;
    json["beta_rad"] = stage.calibration->exact.beta_rad;
    json["wheel_diameter_ratio"] = stage.calibration->wheel_diameter_ratio;
    json["wheelbase_ratio"] = stage.calibration->wheelbase_ratio;
  }
  return json;
}

// What one count of an encoder is on the floor: no return error is known any better.
double count_m(const DifferentialDrive& drive) {
  return 2.0 * kPi * std::max(drive.wheel_radius_left_m, drive.wheel_radius_right_m) / drive.counts_per_wheel_turn();
}

// The first run in which the robot did not arrive, in words; empty where all did.
void note_lost(std::string& lost, const BenchmarkRun& run) {
  if (!run.finished && lost.empty())
    lost = text_of("run %s %d never arrived", run.clockwise ? "cw" : "ccw", run.number);
}

std::string file_name(const BenchmarkRun& run) { return text_of("%s_%d", run.clockwise ? "cw" : "ccw", run.number); }

}  // namespace

Result<RunOutputs> umbmark_outputs(const Scenario& scenario, std::uint64_t seed, const Progress& progress) {
  RunOutputs out;
  std::size_t driven = 0;
  std::string lost;
  const std::size_t runs = 2 * static_cast<std::size_t>(scenario.benchmark->runs_each_way);
  const std::vector<UmbmarkStage> stages = run_umbmark_calibration(
      scenario, seed,
      [&](const BenchmarkRun& run) {
        note_lost(lost, run);
        constexpr const char* kStages[] = {"uncalibrated_", "calibrated_", "compensated_twice_"};
        out.recordings.emplace_back(kStages[driven++ / runs] + file_name(run), run.recording);
      },
      progress);
  if (!lost.empty()) return Error{scenario.name, lost, "a robot that completes its squares"};
  if (stages.size() < 2) return Error{scenario.name, "a benchmark stopped by its user", "one driven to the end"};

  ScatterPicture picture{"Return position errors of the square path", {}};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const UmbmarkMeasure& m = stages[k].measure;
    out.sentences.push_back(text_of("%s: Emax,syst = %s mm (cw %s mm, ccw %s mm), spread %s mm, SEM %s mm.", name_of(k),
                                    millimetres(m.largest_systematic_error_m).c_str(),
                                    millimetres(m.clockwise.distance_m).c_str(),
                                    millimetres(m.counter_clockwise.distance_m).c_str(),
                                    millimetres(m.spread_m).c_str(), millimetres(m.standard_error_m).c_str()));
    rows.push_back({name_of(k), millimetres(m.largest_systematic_error_m), millimetres(m.clockwise.distance_m),
                    millimetres(m.counter_clockwise.distance_m), millimetres(m.spread_m),
                    millimetres(m.standard_error_m)});
    if (stages[k].calibration) add_calibration(out, *stages[k].calibration, stages[k].nominal);
    out.details["stages"].push_back(json_of_stage(stages[k]));
    picture.experiments.push_back({name_of(k), stages[k].runs});
  }
  out.report.table({"[mm]", "Emax,syst", "cw", "ccw", "spread", "SEM"}, rows);
  const double before = stages.front().measure.largest_systematic_error_m,
               after = stages.back().measure.largest_systematic_error_m;
  const double least = count_m(stages.front().nominal);
  const double by_chance = std::max(
      least, 2.0 * std::hypot(stages.front().measure.standard_error_m, stages.back().measure.standard_error_m));
  const double improvement = std::max(before, least) / std::max(after, least);
  if (std::abs(after - before) < by_chance) {
    out.sentences.push_back(
        "From the first to the last, that is no more than the spread of the runs or a count of the encoders makes: "
        "these squares show neither an error of the wheelbase or the wheels' ratio, nor that it was put right.");
  } else if (after < before) {
    out.sentences.push_back(text_of("That is %.1f times better.", improvement));
  } else {
    out.sentences.push_back(
        text_of("That is %.1f times worse: what is wrong here is not the wheelbase and not the ratio of the wheels.",
                1.0 / improvement));
  }
  out.figure("largest_systematic_error_before_m", before);
  out.figure("largest_systematic_error_after_m", after);
  out.figure("improvement", improvement);
  out.figure("compensations", static_cast<double>(stages.size() - 1));
  out.figure("spread_before_m", stages.front().measure.spread_m);

  for (const bool clockwise : {true, false}) {
    const auto alone = calibrate_one_direction(stages.front().runs, clockwise, stages.front().nominal);
    if (!alone) continue;
    out.sentences.push_back(
        text_of("The square driven %s alone would have blamed the wheelbase (Eb = %.4f), promised %s mm, and left %s "
                "mm the other way round.",
                clockwise ? "clockwise" : "counter-clockwise", alone->wheelbase_ratio,
                millimetres(alone->predicted_error_this_way_m).c_str(),
                millimetres(alone->predicted_error_other_way_m).c_str()));
  }
  out.pictures.emplace_back("return_errors", scatter_picture(picture));
  return out;
}

Result<RunOutputs> extended_umbmark_outputs(const Scenario& scenario, std::uint64_t seed, const Progress& progress) {
  Scenario smooth = scenario;
  smooth.floor.bumps.clear();
  RunOutputs out;
  const auto half = [&](double begin) {
    return [&progress, begin](double share) { return goes_on(progress, begin + 0.5 * share); };
  };
  if (scenario.floor.bumps.empty())
    return Error{scenario.name + ": floor.bump", "no bump", "bumps for the extended benchmark"};
  std::string lost;
  const UmbmarkRuns without = run_umbmark(
      smooth, seed, [&](const BenchmarkRun& run) { note_lost(lost, run); }, half(0.0));
  const UmbmarkRuns with = run_umbmark(
      scenario, seed,
      [&](const BenchmarkRun& run) {
        note_lost(lost, run);
        out.recordings.emplace_back("bumps_" + file_name(run), run.recording);
      },
      half(0.5));
  if (!lost.empty()) return Error{scenario.name, lost, "a robot that completes its squares"};
  const auto measure = measure_extended_umbmark(without, with);
  if (!measure || static_cast<int>(with.counter_clockwise.size()) < scenario.benchmark->runs_each_way)
    return Error{scenario.name, "a benchmark stopped by its user", "one driven to the end"};
  goes_on(progress, 1.0);
  out.figure("mean_absolute_heading_error_rad", measure->mean_absolute_heading_error_rad);
  out.figure("mean_absolute_heading_error_deg", degrees(measure->mean_absolute_heading_error_rad));
  out.sentences.push_back(text_of(
      "%zu bumps turn the robot by %.2f degrees on average (Eq. 3.5), after its systematic %.2f degrees cw and %.2f "
      "degrees ccw are taken off (Eq. 3.6).",
      scenario.floor.bumps.size(), degrees(measure->mean_absolute_heading_error_rad),
      degrees(measure->systematic_bias_clockwise_rad), degrees(measure->systematic_bias_counter_clockwise_rad)));
  out.pictures.emplace_back("return_errors", scatter_picture({"Return position errors of the square path",
                                                              {{"without bumps", without}, {"with bumps", with}}}));
  return out;
}

}  // namespace odolab
