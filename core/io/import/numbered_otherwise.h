// Files that are given as one run and seem to be of two.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace odolab {

// A sentence about the first of the files whose name has other numbers in it than the first file's, where both have as
// many: "run-02_opti.csv" beside "run-01_odo.csv". Nothing where all agree.
std::optional<std::string> numbered_otherwise(const std::vector<std::string>& paths);

}  // namespace odolab
