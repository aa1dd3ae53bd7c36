// A square that was recorded instead of typed in.
#pragma once

#include "core/base/result.h"
#include "core/guide/guide_session.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Where the truth's first and last pose say that the robot ended, and where its wheels say so with `nominal`, both from
// the same start. Needs wheels, and a truth with headings at both ends. An Error says what is missing, or that the run
// was no square: it turned less than three corners in one direction.
Result<GuideRun> run_in(const Recording& recording, const Vehicle& nominal);

}  // namespace odolab
