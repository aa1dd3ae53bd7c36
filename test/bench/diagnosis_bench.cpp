// How long a diagnosis takes: six runs, eight minutes of 60 Hz data in all.
#include <benchmark/benchmark.h>

#include "core/diagnosis/diagnosis.h"
#include "physics/simulation.h"

namespace odolab {
namespace {

// Figures of eight forwards, squares with turns on the spot, starts and stops; range(0): what is missing from the
// model.
std::vector<Recording> eight_minutes(int missing) {
  std::vector<Recording> recordings;
  Scenario scenario;
  scenario.actual.wheelbase_m = 0.345;
  scenario.driving.speed_mps = 0.4;
  scenario.driving.acceleration_mps2 = 0.4;
  scenario.sensors = {1.0 / 60.0, 1.0 / 60.0, 0.001, 0.002};
  scenario.floor.roughness.largest_height_m = 0.001;
  if (missing == 1) scenario.effects = {{"lateral_slip", "vehicle", {{"m_per_s_per_mps2", 0.04}}}};
  if (missing == 2)
    scenario.effects = {{"slip_zone", "floor", {{"slip", 0.1}, {"x_m", 1.0}, {"y_m", 0.0}, {"radius_m", 0.4}}}};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    if (seed % 2 == 0)
      scenario.path = SquarePath{6.0, seed % 4 == 0};
    else
      scenario.path = FigureEightPath{1.2, 3};
    Simulation simulation(scenario, seed);
    run_to_end(simulation, 80.0);
    recordings.push_back(simulation.recording());
    recordings.back().name = "run_" + std::to_string(seed);
  }
  return recordings;
}

void DiagnoseEightMinutesAt60Hz(benchmark::State& state) {
  const std::vector<Recording> recordings = eight_minutes(static_cast<int>(state.range(0)));
  double rows = 0.0, findings = 0.0, seconds = 0.0;
  for (const Recording& r : recordings) rows += static_cast<double>(r.time_s.size()), seconds += r.duration_s();
  for (auto _ : state) findings = static_cast<double>(diagnose(recordings, {}, Vehicle{})->findings.size());
  state.counters["rows"] = rows;
  state.counters["recorded_s"] = seconds;
  state.counters["findings"] = findings;
  state.SetLabel(state.range(0) == 0 ? "nothing missing" : state.range(0) == 1 ? "lateral slip" : "slip zone");
}
BENCHMARK(DiagnoseEightMinutesAt60Hz)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace odolab
