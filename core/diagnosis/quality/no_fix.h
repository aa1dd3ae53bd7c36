// Poses that a tracker writes where it sees nothing: exactly 0, 0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Of each row, whether its truth is at exactly x = 0, y = 0 (and heading 0, where there is one) though no pose before
// or behind such rows is within 0.2 m of there. A vehicle that rests at the origin is near it when it leaves.
std::vector<char> rows_without_fix(const Recording& recording);

// Of a recording in which there are such rows, in words.
std::optional<std::string> said_of_rows_without_fix(const Recording& recording, const std::vector<char>& rows);

}  // namespace odolab
