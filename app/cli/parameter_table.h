// What a calibration prints of its parameters, whatever it was made from.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/least_squares.h"

namespace odolab {

// Before, estimate and uncertainty of each; an estimate to the second digit of its uncertainty.
void print_parameters(const std::vector<ParameterEstimate>& parameters);

// Says that no parameter could be determined and returns the exit code of that: a claim failed where a vehicle was
// asked for, since whatever reads `out` next would go on with what lies there from before.
int nothing_determined(const std::string& out);

}  // namespace odolab
