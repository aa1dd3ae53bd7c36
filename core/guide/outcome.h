// What a guide found, in plain words: each number, its unit, its uncertainty, and the setting of the robot it goes
// into.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/internal.h"
#include "core/guide/guide_session.h"

namespace odolab {

// One number to put into the robot.
struct Setting {
  std::string words;  // "diameter of the left wheel"
  std::string key;    // of the vehicle file: "wheel_radius_left_m"
  std::string ros2;   // of ROS 2's diff_drive_controller; empty where it has none
  std::string unit;   // of the three numbers, SI
  double before = 0.0;
  double value = 0.0;
  double stderr_value = 0.0;  // 0: unknown
  bool determined = true;     // false: the drives say nothing about it, it keeps its value
};

// What one round of squares says.
struct RoundOutcome {
  UmbmarkRuns runs;
  std::optional<UmbmarkMeasure> measure;
  std::optional<UmbmarkCalibration> calibration;
  std::optional<OneDirectionCalibration> only_clockwise, only_counter_clockwise;
};
RoundOutcome outcome_of(const GuideRound& round, double side_m);

struct GuideOutcome {
  std::vector<RoundOutcome> rounds;
  std::optional<ScaleCalibration> scale;
  std::optional<ExtendedUmbmark> extended;
  std::vector<Setting> settings;       // empty until there is a calibration
  std::optional<Vehicle> calibrated;   // with the settings in it
  std::vector<std::string> sentences;  // what was found
  std::vector<std::string> warnings;   // what to doubt
  bool compensate_again = false;       // the rule of 3 SEM says that a second compensation is worth while
};

// `internal` is what calibrate_internally found in the session's recordings; null where nothing yet, or in a guide of
// squares.
GuideOutcome outcome_of(const GuideSession& session, const InternalCalibration* internal = nullptr);

}  // namespace odolab
