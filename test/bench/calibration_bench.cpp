// How long a calibration from whole recordings takes.
#include <benchmark/benchmark.h>

#include "core/calibration/least_squares.h"
#include "physics/simulation.h"

namespace odolab {
namespace {

// Six figure-eights of 80 s with 60 Hz encoders and truth: eight minutes in all.
std::vector<Recording> eight_minutes() {
  std::vector<Recording> recordings;
  Scenario scenario;
  scenario.actual.wheelbase_m = 0.345;
  scenario.driving.speed_mps = 0.4;
  scenario.path = FigureEightPath{1.2, 2};
  scenario.sensors = {1.0 / 60.0, 1.0 / 60.0, 0.001, 0.002};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Simulation simulation(scenario, seed);
    run_to_end(simulation);
    recordings.push_back(simulation.recording());
  }
  return recordings;
}

void CalibrateEightMinutesAt60Hz(benchmark::State& state) {
  const std::vector<Recording> recordings = eight_minutes();
  double rows = 0.0;
  for (const Recording& r : recordings) rows += static_cast<double>(r.time_s.size());
  double wheelbase_m = 0.0;
  for (auto _ : state)
    wheelbase_m = std::get<DifferentialDrive>(calibrate_least_squares(recordings, Vehicle{})->vehicle.kind).wheelbase_m;
  state.counters["rows"] = rows;
  state.counters["wheelbase_mm"] = 1e3 * wheelbase_m;
}
BENCHMARK(CalibrateEightMinutesAt60Hz)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace odolab
