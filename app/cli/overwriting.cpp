#include "app/cli/overwriting.h"

#include <filesystem>

namespace odolab {

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return a == b || std::filesystem::equivalent(a, b, ignored);
}

std::optional<Error> overwritten(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].empty()) continue;
    for (const std::string& input : inputs)
      if (!input.empty() && is_same_file(outputs[i], input))
        return Error{outputs[i], "a file to write that is read as well", "another one: it would be lost"};
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].empty() && is_same_file(outputs[i], outputs[k]))
        return Error{outputs[i], "one file for two outputs", "one for each"};
  }
  return std::nullopt;
}

}  // namespace odolab
