// The fit that knows the form: calibration together with the size of each effect, whose motion is known from the
// simulator. It says how much of an effect is left to be seen after calibration, and how much of the error it removes.
#pragma once

#include <vector>

#include "core/calibration/innovations.h"

namespace odolab::concealed {

// The runs hold the motion of each effect at its true size as extra columns, in the order of the effects.

struct OracleFit {
  InnovationModel model;
  std::vector<double> size;  // of each effect, 1 is right
  std::vector<double>
      significance;  // of each effect at size 1 with calibration and the others fitted beside it, in sigma
};

// At the true parameters, without fitting anything.
std::vector<double> significance(const std::vector<InnovationRun>& runs, const InnovationModel& truth);

// Fits drive, mounting, a clock for each run and the sizes; the noise is known.
OracleFit oracle_fit(std::vector<InnovationRun> runs, const InnovationModel& start);

// Dead reckoning of the tracked point with such a model.
Track oracle_track(const InnovationRun& run, const InnovationModel& model, const std::vector<double>& size);

}  // namespace odolab::concealed
