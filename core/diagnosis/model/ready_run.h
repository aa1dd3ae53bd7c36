// A checked recording made ready for the joint model.
#pragma once

#include "core/calibration/innovations.h"
#include "core/calibration/least_squares.h"
#include "core/diagnosis/quality/quality.h"

namespace odolab {

// The run with its faults left out and, where commands stand in for wheels, held as commands are.
Result<InnovationRun> ready_run(const CheckedRecording& checked, const Vehicle& vehicle);

// Of a calibration, with the clock of the `recording`-th of those that it was fitted to, or the usual one of others.
InnovationModel model_of(const LeastSquaresCalibration& calibration, std::size_t recording);

// Puts a run's stamps right by its clock, and that clock into its model.
void put_clock_right(InnovationRun& run, InnovationModel& model, const AlignedClock& clock);

// All of them, with as few samples as say the same: truth that comes often is averaged, without what contradicts the
// calibration for less than that, and readings that come often are left out. `were_fitted`: by the calibration, in that
// order. `clocks`: of each, where the calibration holds once these are right; stamps stay as they are. An error for
// each that cannot be read.
std::vector<Result<InnovationRun>> condensed_runs(const std::vector<CheckedRecording>& checked, const Vehicle& vehicle,
                                                  const LeastSquaresCalibration& calibration, bool were_fitted,
                                                  const std::vector<AlignedClock>& clocks);

}  // namespace odolab
