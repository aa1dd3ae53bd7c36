// A heading that nobody measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Where a tracker knows places alone, logs hold one heading throughout, mostly 0. Says so of a truth whose headings are
// all the same while the wheels turn the vehicle; nothing of others.
std::optional<std::string> unmeasured_heading(const std::vector<TruthSample>& truth,
                                              const std::vector<WheelSample>& wheels, const DifferentialDrive& drive);

}  // namespace odolab
