// What the panels of Compare show: a recording beside the simulation that replays it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/least_squares.h"
#include "core/geometry/track.h"
#include "ui/actions.h"

namespace odolab::ui {

// A track with its error against the recorded truth.
struct ComparedTrack {
  const Track* track = nullptr;
  std::optional<TrackError> error;
};

// The recording's tracks by one vehicle file.
struct ReplayFigures {
  ComparedTrack simulated;
  ComparedTrack dead_reckoning;
};

struct Compare {
  bool loaded = false;
  std::vector<std::string> example_files;  // scenarios that replay a recording
  std::string name;
  std::string provenance;
  std::string inputs;  // "wheel rotation", "commands"
  double duration_s = 0.0;
  double travelled_m = 0.0;
  std::size_t truth_samples = 0;
  std::string vehicle_name;
  std::string estimator = "dead reckoning";  // that the recording's own inputs were given to
  double mass_kg = 0.0;                      // that the simulation assumes
  ReplayVehicle vehicle = ReplayVehicle::nominal;
  std::optional<ReplayFigures> nominal, calibrated;
  const LeastSquaresCalibration* calibration = nullptr;
  bool can_calibrate = true;
  std::string why_not;
  std::string job;  // what runs now; empty where nothing does
  double share_done = 0.0;
};

}  // namespace odolab::ui
