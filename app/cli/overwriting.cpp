#include "app/cli/overwriting.h"

#include <filesystem>

#include "app/cli/terminal.h"
#include "core/io/whole_file.h"

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
        return Error{name_of_output(outputs[i]), "one file for two outputs", "one for each"};
  }
  return std::nullopt;
}

std::optional<Error> unusable_output(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  if (std::optional<Error> lost = overwritten(outputs, inputs)) return lost;
  for (const std::string& output : outputs)
    if (!output.empty())
      if (std::optional<Error> problem = unwritable(output)) return problem;
  return std::nullopt;
}

}  // namespace odolab
