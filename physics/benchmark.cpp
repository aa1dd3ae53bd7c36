#include "physics/benchmark.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

// A robot that has lost its way drives on for good; this many times the planned duration is enough.
constexpr double kPatience = 3.0;

// One square: absolute minus calculated pose (Eq. 3.1), seen from the absolute pose at the start.
ReturnError drive_square(const Scenario& scenario, std::uint64_t seed) {
  Simulation simulation(scenario, seed);
  run_to_end(simulation, kPatience * simulation.expected_duration_s());
  const Pose driven = between(scenario.start, simulation.state().estimated_pose);       // by dead reckoning
  const Pose measured = between(simulation.measured_start(), simulation.measured_end());  // by the sonar corner
  return {measured.x_m - driven.x_m, measured.y_m - driven.y_m, wrapped(measured.heading_rad - driven.heading_rad)};
}

}  // namespace

UmbmarkRuns run_umbmark(const Scenario& scenario, std::uint64_t seed, const OnBenchmarkRun& on_run, const Progress& progress) {
  const int runs = 2 * scenario.benchmark.value_or(Benchmark{}).runs_each_way;
  UmbmarkRuns result;
  result.side_m = std::get<SquarePath>(scenario.path).side_m;
  std::vector<ReturnError> errors(static_cast<std::size_t>(runs));
  parallel_for(
      runs,
      [&](int i) {
        Scenario run = scenario;
        std::get<SquarePath>(run.path).clockwise = i % 2 == 0;
        run.sensors.truth_period_s = 0.0;
        errors[static_cast<std::size_t>(i)] = drive_square(run, seed_of_stream(seed, 1000 + static_cast<std::uint64_t>(i)));
      },
      [&](int i) {
        const BenchmarkRun run{i % 2 == 0, i / 2 + 1, errors[static_cast<std::size_t>(i)]};
        (run.clockwise ? result.clockwise : result.counter_clockwise).push_back(run.error);
        if (on_run) on_run(run);
      },
      progress);
  return result;
}

}  // namespace odolab
