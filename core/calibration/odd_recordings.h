// Recordings that do not go with the others: of another vehicle, or of the same one on other tyres or with a load.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/external.h"

namespace odolab {

struct OddRecording {
  struct Length {
    std::string name;  // the vehicle file's key
    double by = 0.0;   // the share by which the recording's own is larger than that of those it does not go with
  };
  std::size_t index = 0;
  std::vector<std::size_t> others;  // with which it does not go, and which go with one another
  std::vector<Length> lengths;      // that are too far off
};

// `own`: the parameters of each recording, calibrated by itself; empty where it cannot be. Two recordings do not go
// with one another where a length differs by 1 % or more and beyond the errors of both, as calibration states them,
// with p < 1e-4. Those that go with the one that most go with are the others.
std::vector<OddRecording> odd_recordings(const std::vector<std::vector<ParameterEstimate>>& own);

// The same of recordings, each calibrated by itself as `options` have it. What `progress` stops is not whole.
std::vector<OddRecording> odd_recordings(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                         const LeastSquaresOptions& options = {}, const Progress& progress = {});

// In one sentence; `names` of all recordings.
std::string in_words(const OddRecording& odd, const std::vector<std::string>& names);

}  // namespace odolab
