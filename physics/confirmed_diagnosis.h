// A diagnosis with its confirmation: the simulator driven by the recordings' own inputs, without the findings and with
// them.
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/diagnosis/diagnosis.h"
#include "core/lesson/lesson.h"
#include "physics/model_replay.h"

namespace odolab {

// `Diagnosis::simulation` is filled in; what the planar world could not switch on is among the warnings.
Result<Diagnosis> confirmed_diagnosis(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                      const Vehicle& nominal, const Progress& progress = {});

// The recording, fitted or held out, without the truth that a diagnosis set aside: outliers and what a tracker repeated
// say nothing of the vehicle, and a simulation is not judged by them; nor by what lies between samples that were taken
// far apart, since a tracker smoothed it. As it is where the diagnosis does not know it by its name or its stamps.
Recording with_truth_that_was_used(Recording recording, const Diagnosis& diagnosis);

// Where encoders are at fault, or nobody read them, or the truth jumps, or it and the wheels part: on the truth's
// clock, as `model` has it, and a reading wider at either end.
WaysUnknown ways_unknown(const std::vector<Recording>& recordings, const Diagnosis& diagnosis,
                         const FittedModel& model);

// A lesson's concealed robot drives all of its drives, and they are diagnosed; an error where one does not arrive.
Result<Diagnosis> diagnosed(const Mystery& mystery, const Progress& progress = {});

}  // namespace odolab
