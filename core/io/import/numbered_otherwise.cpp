#include "core/io/import/numbered_otherwise.h"

#include <cctype>
#include <filesystem>

namespace odolab {

namespace {

std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

std::vector<std::string> numbers_in(const std::string& name) {
  std::vector<std::string> numbers;
  bool within = false;
  for (const char c : name) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(c));
    if (is_digit && !within) numbers.emplace_back();
    if (is_digit) numbers.back() += c;
    within = is_digit;
  }
  return numbers;
}

}  // namespace

std::optional<std::string> numbered_otherwise(const std::vector<std::string>& paths) {
  if (paths.empty()) return std::nullopt;
  const std::vector<std::string> first = numbers_in(stem_of(paths.front()));
  for (const std::string& path : paths) {
    const std::vector<std::string> numbers = numbers_in(stem_of(path));
    if (numbers.size() == first.size() && numbers != first)
      return "the names of " + paths.front() + " and " + path + " have different numbers in them: are both of one run?";
  }
  return std::nullopt;
}

}  // namespace odolab
