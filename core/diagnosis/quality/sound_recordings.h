// Recordings made ready for those who calibrate from them: the command line and the window.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/least_squares.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct SoundRecordings {
  std::vector<Recording> recordings;
  LeastSquaresOptions how;        // to calibrate from them: with what is left out of each
  std::vector<std::string> said;  // what was put right or is left out, each in one line
};

// Readings at fault bridged, and a truth that sat elsewhere in one run carried to where it sat in the others. What
// `progress` stops is not whole.
SoundRecordings sound_recordings(std::vector<Recording> recordings, const Vehicle& nominal,
                                 const Progress& progress = {});

}  // namespace odolab
