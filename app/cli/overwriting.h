// No command writes over what it reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace odolab {

bool is_same_file(const std::string& a, const std::string& b);

// The first output that is one of the inputs, or another output. Empty paths are none.
std::optional<Error> overwritten(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace odolab
