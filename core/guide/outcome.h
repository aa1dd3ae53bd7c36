// What a guide found, in plain words: each number, its unit, its uncertainty, and the setting of the robot it goes
// into.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/internal.h"
#include "core/guide/guide_session.h"
#include "core/recording/recording.h"

namespace odolab {

// One number to put into the robot.
struct Setting {
  std::string words;    // "diameter of the left wheel"
  std::string key;      // of the vehicle file: "wheel_radius_left_m"
  std::string ros2;     // of ROS 2's diff_drive_controller; empty where it has none
  std::string unit;     // of the three numbers, SI
  double before = 0.0;  // what the robot had on the drives that the value was found from
  double value = 0.0;
  double stderr_value = 0.0;   // 0: unknown
  bool determined = true;      // false: the drives say nothing about it, it keeps its value
  bool file_has_half = false;  // these are diameters, and the key is that of a radius
};

// What one round of squares says.
struct RoundOutcome {
  UmbmarkRuns runs;
  std::optional<UmbmarkMeasure> measure;
  std::optional<UmbmarkCalibration> calibration;
  std::optional<OneDirectionCalibration> only_clockwise, only_counter_clockwise;
};
RoundOutcome outcome_of(const GuideRound& round, double side_m);

// How far the odometry of a drive ends from the truth, with the numbers as they were and with the new ones.
struct HeldOutError {
  std::string name;
  double before_m = 0.0, before_rad = 0.0;
  double after_m = 0.0, after_rad = 0.0;
};

// Needs the true pose with a heading at the start, and the true position at the end; a heading there where there is
// one.
Result<HeldOutError> held_out_error(const Recording& recording, const Vehicle& before, const Vehicle& after);

struct GuideOutcome {
  std::vector<RoundOutcome> rounds;
  std::optional<ScaleCalibration> scale;
  std::optional<ExtendedUmbmark> extended;
  std::vector<Setting> settings;       // empty until there is a calibration
  std::optional<Vehicle> calibrated;   // with the settings in it
  std::vector<std::string> sentences;  // what was found
  std::vector<std::string> verdict;    // those of them on what the calibration leaves
  std::vector<std::string> warnings;   // what to doubt
  std::vector<HeldOutError> held_out;
  bool compensate_again = false;  // a second compensation is worth while (core/guide/rest.h)
};

// `internal` is what calibrate_internally found in the session's recordings; null where nothing yet, or in a guide of
// squares. `held_out` are drives that it has not seen.
GuideOutcome outcome_of(const GuideSession& session, const InternalCalibration* internal = nullptr,
                        const std::vector<Recording>& held_out = {});

}  // namespace odolab
