// Faults of the data themselves, found before any physics is looked for: truth that repeats itself, encoders that stand
// still or jump while the vehicle drives on, or were not read.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/calibration/aligned_clock.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

inline constexpr const char* kEncoderGap = "encoder_gap";

struct DataFault {
  std::string effect;     // "truth_frozen" or "encoder_data_fault"; kEncoderGap is none: nothing is wrong that is there
  std::string component;  // "truth", "left_wheel", "right_wheel", "both_wheels"
  std::string recording;
  std::vector<std::pair<double, double>> time_s;
  std::string sentence;
};

// Recording, times and sentence in one line.
std::string in_words(const DataFault& fault);

struct CheckedRecording {
  // Without the frozen truth, on even stamps where those were of arrival; with wheels in place of commands where there
  // are only commands.
  Recording recording;
  bool from_commands = false;
  std::vector<DataFault> faults;
  std::vector<std::string> warnings;  // what was put right
  // From one reading to another, in order and apart: no motion across these may be trusted.
  std::vector<std::pair<double, double>> left_out_s;
};

// `clock`: the truth's, where it is known to be another than the vehicle's file says.
CheckedRecording checked(const Recording& recording, const Vehicle& vehicle,
                         const std::optional<AlignedClock>& clock = {});

}  // namespace odolab
