// Calibration of vehicles whose encoders contradict each other from the inside: no outside truth is needed, but for
// what only a ruler can tell.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/calibration/least_squares.h"

namespace odolab {

struct InternalCalibration {
  Vehicle vehicle;                            // with the estimates put in
  std::vector<ParameterEstimate> parameters;  // named by the vehicle file's keys
  std::vector<std::string> taken_as_known;    // what the estimates rest on, in sentences
  std::vector<std::string> cannot_tell;       // what these recordings cannot determine, and which drive would
  std::vector<std::string> warnings;
};

// True for the kinds that calibrate_internally knows: clapper, omnimate, multi_castor, smart_encoder_trailer.
bool can_calibrate_internally(const Vehicle& vehicle);

// By the kind's own method: calibrate_castors, calibrate_linked or calibrate_trailer.
Result<InternalCalibration> calibrate_internally(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                 const Progress& progress = {});

}  // namespace odolab
