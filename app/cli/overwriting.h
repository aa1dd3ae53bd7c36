// No command writes over what it reads, nor works for what it cannot write.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace odolab {

bool is_same_file(const std::string& a, const std::string& b);

// The first output that is one of the inputs, or another output. Empty paths are none.
std::optional<Error> overwritten(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// The first output that is overwritten so, or cannot be written. Asked before the work begins.
std::optional<Error> unusable_output(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace odolab
