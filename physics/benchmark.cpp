#include "physics/benchmark.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

// A robot that has lost its way drives on for good; this many times the planned duration is enough.
constexpr double kPatience = 3.0;

// One square: absolute minus calculated pose (Eq. 3.1), seen from the absolute pose at the start.
ReturnError return_error(const Simulation& simulation, const Scenario& scenario) {
  const Pose driven = between(scenario.start, simulation.state().estimated_pose);         // by dead reckoning
  const Pose measured = between(simulation.measured_start(), simulation.measured_end());  // by the sonar corner
  return {measured.x_m - driven.x_m, measured.y_m - driven.y_m, wrapped(measured.heading_rad - driven.heading_rad)};
}

void drive_clockwise(Path& path, bool clockwise) {
  if (auto* rectangle = std::get_if<RectanglePath>(&path))
    rectangle->clockwise = clockwise;
  else
    std::get<SquarePath>(path).clockwise = clockwise;
}

double side_of(const Path& path) {
  const auto* rectangle = std::get_if<RectanglePath>(&path);
  return rectangle ? rectangle->length_m : std::get<SquarePath>(path).side_m;
}

}  // namespace

UmbmarkRuns run_umbmark(const Scenario& scenario, std::uint64_t seed, const OnBenchmarkRun& on_run,
                        const Progress& progress) {
  const int runs = 2 * scenario.benchmark.value_or(Benchmark{}).runs_each_way;
  UmbmarkRuns result;
  result.side_m = side_of(scenario.path);
  std::vector<BenchmarkRun> driven(static_cast<std::size_t>(runs));
  parallel_for(
      runs,
      [&](int i, const std::atomic<bool>& stopped) {
        Scenario run = scenario;
        drive_clockwise(run.path, i % 2 == 0);
        run.sensors.truth_period_s = 0.0;
        Simulation simulation(run, seed_of_stream(seed, 1000 + static_cast<std::uint64_t>(i)));
        const double longest_s = kPatience * simulation.expected_duration_s();
        while (!simulation.state().finished && simulation.state().time_s < longest_s && !stopped) simulation.step();
        driven[static_cast<std::size_t>(i)] = {i % 2 == 0, i / 2 + 1, return_error(simulation, run),
                                               simulation.state().finished, simulation.recording()};
      },
      [&](int i) {
        const BenchmarkRun& run = driven[static_cast<std::size_t>(i)];
        (run.clockwise ? result.clockwise : result.counter_clockwise).push_back(run.error);
        if (on_run) on_run(run);
      },
      progress);
  return result;
}

std::vector<UmbmarkStage> run_umbmark_calibration(const Scenario& scenario, std::uint64_t seed,
                                                  const OnBenchmarkRun& on_run, const Progress& progress) {
  constexpr int kMostStages = 3;
  std::vector<UmbmarkStage> stages;
  Scenario next = scenario;
  for (int k = 0; k < kMostStages; ++k) {
    const Progress part = [&](double share) { return goes_on(progress, (k + share) / kMostStages); };
    UmbmarkStage stage;
    stage.nominal = std::get<DifferentialDrive>(next.vehicle.kind);
    stage.runs = run_umbmark(next, seed_of_stream(seed, static_cast<std::uint64_t>(k)), on_run, part);
    const int runs = next.benchmark.value_or(Benchmark{}).runs_each_way;
    if (static_cast<int>(stage.runs.counter_clockwise.size()) < runs) break;  // stopped
    stage.measure = *measure_umbmark(stage.runs);
    const bool compensate = k == 0 || (k == 1 && stage.measure.worth_compensating);
    if (compensate) stage.calibration = calibrate_umbmark(stage.runs, stage.nominal);
    stages.push_back(stage);
    if (!stage.calibration) break;
    next.vehicle.kind = stage.calibration->corrected;
  }
  goes_on(progress, 1.0);
  return stages;
}

}  // namespace odolab
