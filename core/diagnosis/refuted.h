// Whether what nobody fitted speaks against an answer.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// Dead reckoning is a tenth worse with the findings than by calibration alone, and no better in heading: over what was
// left out or held out, and in the simulator that the recording's own inputs drive. Not where nothing was found that
// either could show.
bool is_refuted_by_unseen(const Diagnosis& diagnosis);
bool is_refuted_by_simulator(const Diagnosis& diagnosis);

// Whether the simulator goes the ways that were recorded: by the calibration alone it errs by no more than twice what
// the calibrated model does, in place or in heading, of what was fitted or what was held out, whichever is worse.
// Castors that turn over to another side, or poses at both ends alone, of which its error is a whole run's, make it err
// by more: then it neither confirms nor refutes.
bool simulator_follows(const Diagnosis& diagnosis);

// What was found that the simulator cannot play: of a form or size that it does not have. Then it
// does not refute either.
std::vector<Finding> beyond_the_simulator(const Diagnosis& diagnosis);

}  // namespace odolab
