// Recordings for those who know nothing of faults: calibration and prediction.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/calibration/aligned_clock.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct BridgedRecording {
  // As it was given where no encoder is at fault. Else rotations alone, on even stamps, without the readings at fault:
  // a counter that begins anew goes on where it was.
  Recording recording;
  std::vector<std::pair<double, double>> left_out_s;  // the way across these is not known
  std::vector<std::string> said;                      // each fault in one line
};

enum class Looks { at_wheels_alone, at_truth_too };

// Of a differential or tracked drive; of other kinds, and of commands, nothing is changed. `clock`: the truth's, where
// it is known to be another than the vehicle's file says.
BridgedRecording bridged_recording(const Recording& recording, const Vehicle& vehicle, Looks looks,
                                   const std::optional<AlignedClock>& clock = {});

}  // namespace odolab
