// How many simulated seconds pass in a real one.
#pragma once

#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include "physics/simulation.h"

namespace odolab {

inline void count_real_time(benchmark::State& state, double simulated_s) {
  state.counters["times_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}

// Box2D alone, a second of 1 ms steps at a time.
inline void step_on(benchmark::State& state, b2World& world) {
  double simulated_s = 0.0;
  for (auto _ : state) {
    for (int k = 0; k < 1000; ++k) world.Step(0.001f, 8, 3);
    simulated_s += 1.0;
  }
  count_real_time(state, simulated_s);
}

// A whole run at 1 ms: motors, encoders, odometry, controller, driver and truth.
inline void whole_runs(benchmark::State& state, const Scenario& scenario) {
  double simulated_s = 0.0;
  for (auto _ : state) {
    Simulation simulation(scenario, 1);
    run_to_end(simulation);
    simulated_s += simulation.state().time_s;
  }
  count_real_time(state, simulated_s);
}

}  // namespace odolab
