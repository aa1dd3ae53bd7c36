// A scenario that is run to its end.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "physics/simulation.h"

namespace odolab {

// In the planar physics; that it gets there within ten minutes of its own time is expected.
inline Simulation finished(const Scenario& scenario, std::uint64_t seed = 1) {
  Simulation simulation(scenario, seed);
  run_to_end(simulation, 600.0);
  EXPECT_TRUE(simulation.state().finished);
  return simulation;
}

}  // namespace odolab
