// The outside measurement of the pose, taken out of a recording row by row.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Whether a channel of that name belongs to the outside measurement of the pose.
bool is_of_truth(const std::string& channel);

// Empties the truth's cells in the rows that are marked; `rows` has an entry for each row of the recording.
void leave_truth_out(Recording& recording, const std::vector<char>& rows);

}  // namespace odolab
