// The CLAPPER of the paper's section 6 and what its experiments measure on it.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "physics/simulation.h"

namespace odolab {

// Two LabMates, link of 1 m, 0.3 degrees and 0.1 mm, 40 ms, just below 0.5 m/s, sonar of 2 mm and 0.25 degrees; smooth
// floor.
Scenario report_clapper(Path path, bool internal_correction);
// What of it the paper does not give.
std::string report_clapper_assumptions();

// Absolute minus perceived pose at the end, seen from the start: the paper's return position error.
struct ReturnPose {
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
  bool finished = false;
  double position_m() const;
};
ReturnPose return_error(const Simulation& simulation);

// Runs to the end, giving a lost robot up after three times the planned time.
ReturnPose run_and_return(Simulation& simulation);

}  // namespace odolab
