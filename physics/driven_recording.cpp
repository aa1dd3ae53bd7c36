#include "physics/driven_recording.h"

#include <algorithm>

#include "physics/simulation.h"

namespace odolab {

std::optional<Recording> driven_recording(const Scenario& scenario, std::uint64_t seed, const Progress& progress) {
  constexpr double kPatience = 3.0;  // a robot that has lost its way drives on for good
  Simulation simulation(scenario, seed);
  const double expected_s = std::max(1.0, simulation.expected_duration_s());
  for (long k = 0; !simulation.state().finished && simulation.state().time_s < kPatience * expected_s; ++k) {
    simulation.step();
    if (k % 1000 == 0 && !goes_on(progress, simulation.state().time_s / expected_s)) return std::nullopt;
  }
  if (!simulation.state().finished) return std::nullopt;
  Recording recording = simulation.recording();
  recording.name = scenario.name;
  return recording;
}

}  // namespace odolab
