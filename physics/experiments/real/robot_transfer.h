// What was found on some robots, tried on another of the same make, of which only what must be its own is fitted.
#pragma once

#include <optional>

#include "core/diagnosis/fitted_model.h"
#include "core/recording/recording.h"

namespace odolab {

// Error gathered over each metre or radian, from a true start: the median over all of them, which a push or a robot
// that was carried away does not move.
struct TypicalError {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

struct TransferErrors {
  TypicalError nominal;           // commands at their word
  TypicalError as_the_others;     // the others' calibration, mounting and clock, and nothing else
  TypicalError own;               // its own scales, mounting and clock, without findings
  TypicalError own_and_findings;  // its own besides the others' findings
};

// A robot that is known by its commands. Its own are the scales of speed and yaw rate, the yaw that comes with speed,
// the tracked point and the truth's clock: fitted on the first `share` of the recording (least error gathered over a
// metre or a radian, by simplex), judged on the rest. The findings' numbers stay as the others gave them. Nothing where
// the recording has no commands or too little truth.
std::optional<TransferErrors> transferred(const FittedModel& others, const Vehicle& nominal, const Recording& robot,
                                          double share);

// A recording predicted by a model of others, frozen but for the truth's clock, which was set by hand for each file:
// the offset within 0.3 s that gives the least error, and where the others' clocks were found to have rates of their
// own the rate within 0.5 %. Nothing where there is too little truth.
std::optional<TrackError> with_own_clock(const FittedModel& others, const Recording& recording);

}  // namespace odolab
