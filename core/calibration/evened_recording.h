// Recordings whose stamps are those of arrival, put back onto the even period at which they were taken; or of which some
// repeat the one before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

struct EvenedRecording {
  Recording recording;            // rows in order of their new times; wheels and truth of one row may come apart
  std::vector<std::string> said;  // what was done, for whoever reads the report
};

// Rows that say the same twice are read once. Nothing where all stamps are to be believed (`even_stamps`, `spread_repeated`): the wheels' way decides for the
// encoders, the truth's own path for the truth.
std::optional<EvenedRecording> evened(const Recording& recording, const DifferentialDrive& drive);

// The same of a linked or castor vehicle, of which all encoders are read at once: their columns.
std::optional<EvenedRecording> evened(const Recording& recording, const std::vector<std::string>& encoders);

}  // namespace odolab
