// Reads TOML into plain structs whose in-class defaults hold where a key is absent, and remembers what it was asked:
// a key that nobody asked for is an error.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/pose.h"

namespace odolab {

// A table of a TOML file; copies refer to the same one. Getters leave `value` alone where the key is absent. The first
// thing that is wrong is kept and comes out of finish(), so that a reader is a plain list of fields.
class TomlTable {
 public:
  // Errors name file and line of a syntax error.
  static Result<TomlTable> read(const std::string& path);
  static Result<TomlTable> parse(const std::string& text, const std::string& path);

  bool present() const;             // false for a sub-table that the file does not have
  bool has(const char* key) const;  // does not count as asking
  bool has_table(const char* key) const;
  void require(const char* key);  // an error where the key is absent, that names all that one table lacks
  void require_table(const char* key);

  void field(const char* key, double& value);  // integers are read too; infinities are an error
  void field(const char* key, int& value);
  void field(const char* key, std::uint64_t& value);
  void field(const char* key, bool& value);
  void field(const char* key, std::string& value);
  void field(const char* key, std::optional<double>& value);
  void field(const char* key, std::vector<double>& values);
  void field(const char* key, std::vector<Vec2>& points);  // [[x, y], ...]

  // One of several words; the enumerators count from zero in the words' order.
  template <typename Enum>
  void choice(const char* key, Enum& value, const std::vector<std::string>& words) {
    value = static_cast<Enum>(index_of_choice(key, static_cast<std::size_t>(value), words));
  }
  std::size_t index_of_choice(const char* key, std::size_t otherwise, const std::vector<std::string>& words);

  // A sub-table, empty where it is absent; and an array of tables, which may be absent too.
  TomlTable table(const char* key);
  std::vector<TomlTable> tables(const char* key);

  // "file:line" of a key given by its path from the top, e.g. "floor.bump[2].height_m" (counted from 1), or of the
  // nearest table above it that stands in the file; else the file alone.
  std::string place_of(const std::string& key_path) const;

  // A sentence "key: found …, expected …" of some problems_in() as an error at the key's line.
  Error error_of(const std::string& problem) const;

  // Keeps an error if it is the first.
  void fail(Error error);
  // The first error so far: for readers that cannot go on.
  const std::optional<Error>& failure() const;

  // What went wrong first, or else the first key in the whole file that nobody asked for, with the nearest known key.
  Result<Done> finish() const;

 private:
  void require(const char* key, const std::string& named);
  struct File;
  struct Node;
  TomlTable(std::shared_ptr<File> file, Node* node) : file_(std::move(file)), node_(node) {}

  std::shared_ptr<File> file_;
  Node* node_;  // owned by the file
};

}  // namespace odolab
