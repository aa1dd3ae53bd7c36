// Writes TOML with the same calls by which TomlTable reads it, so that one list of fields serves both.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

// Text that grows key by key. Keys of a table stand before its sub-tables, as TOML wants it.
class TomlText {
 public:
  void comment(const std::string& text);
  void table(const std::string& path);          // [path], the fields that follow belong to it
  void table_element(const std::string& path);  // [[path]]

  void field(const char* key, double value);  // reads back to the same bits
  void field(const char* key, int value);
  void field(const char* key, std::uint64_t value);  // up to 2^63 - 1, all that TOML can hold
  void field(const char* key, bool value);
  void field(const char* key, const std::string& value);
  void field(const char* key, const std::optional<double>& value);  // left out where there is none
  void field(const char* key, const std::vector<double>& values);
  void field(const char* key, const std::vector<Vec2>& points);

  template <typename Enum>
  void choice(const char* key, Enum value, const std::vector<std::string>& words) {
    field(key, words[static_cast<std::size_t>(value)]);
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace odolab
