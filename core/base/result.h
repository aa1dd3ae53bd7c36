// A value, or the one sentence that says why there is none.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace odolab {

// What was wrong with an input: where (file, line or key), what was found there and what was expected.
struct Error {
  std::string where;
  std::string found;
  std::string expected;

  // One line, e.g. "labmate.toml:5: wheelbase_m: found 0, expected a length above 0 m".
  std::string message() const {
    std::string text = where;
    if (!found.empty()) text += ": found " + found;
    if (!expected.empty()) text += (found.empty() ? ": expected " : ", expected ") + expected;
    return text;
  }
};

// Holds either a T or an Error. Reading the one that is not there is a bug and asserts.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Error error) : error_(std::move(error)) {}

  bool ok() const { return value_.has_value(); }
  explicit operator bool() const { return ok(); }
  T& value() {
    assert(ok());
    return *value_;
  }
  const T& value() const {
    assert(ok());
    return *value_;
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const {
    assert(!ok());
    return error_;
  }

 private:
  std::optional<T> value_;
  Error error_;
};

// The Result of a function that has nothing to give back but success.
struct Done {};

}  // namespace odolab
