// Calibration against an outside truth for every kind that is made of differential drives: the drive itself, tracks
// that seem wider than they are, and a vehicle with a trailer, each part by `least_squares`.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/least_squares.h"

namespace odolab {

struct CalibratedPart {
  std::string name;                     // empty where the vehicle is one drive; "tow", "trailer"
  LeastSquaresCalibration calibration;  // parameters named by the whole vehicle's keys; `vehicle` is the part
};

struct ExternalCalibration {
  Vehicle vehicle;  // with the estimates put in
  std::vector<CalibratedPart> parts;
};

// True for differential_drive, tracked, encoder_trailer and smart_encoder_trailer.
bool can_calibrate_externally(const Vehicle& vehicle);

// Tracked: radii of the sprockets and slip_factor, that is how much wider the vehicle turns than `track_width_m`; a
// mean over these drives, since slip depends on the turn's radius. With a trailer, the truth being the towing
// vehicle's: first that one by its own wheels; then the trailer, a drive whose truth is carried back over hitch and
// drawbar by the hitch angle as read. Where it seems to sit off that place or turned against it, the drawbar is longer
// and the hitch's encoder biased. Needs a truth with headings. Errors as calibrate_least_squares.
// `options`: of each part; where the truth's mounting is held, that of the towing vehicle.
Result<ExternalCalibration> calibrate_externally(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                 const Progress& progress = {},
                                                 const LeastSquaresOptions& options = {});

}  // namespace odolab
