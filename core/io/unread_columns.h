// Columns of a recording that nobody reads, and that may be meant to be read.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// A sentence for each column that looks like one which is missing: 'truth_theta_rad' where there is no
// 'truth_heading_rad'. Any other column may stand in a recording and is kept.
std::vector<std::string> unread_columns(const Recording& recording);

}  // namespace odolab
