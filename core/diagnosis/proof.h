// How well runs are predicted before and after: by what was only calibrated, with the findings, with a flexible spline,
// and with a term of equal freedom that means nothing.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/joint_model.h"
#include "core/diagnosis/quality.h"

namespace odolab {

// `spline` is let in beside calibration, whatever its evidence.
// Fills in `train` and `held_out`; nothing is fitted to the held-out runs but the truth's clock of each. Without any
// each run is left out in turn.
void prove(Diagnosis& d, const JointModel& joint, const JointModel& calibrated,
           const std::shared_ptr<const Effect>& spline, const std::vector<Recording>& train,
           const std::vector<CheckedRecording>& ready_held_out, const Vehicle& nominal);

// Of the accepted effects the one by which runs that were not fitted are predicted worse than chance could make it, if
// any; the worst of them. Runs as in `prove`.
std::optional<std::size_t> refuted(const JointModel& joint, const JointModel& calibrated, const Diagnosis& d,
                                   const std::vector<CheckedRecording>& ready_held_out, const Vehicle& nominal);

}  // namespace odolab
