// Values that become a JSON file, in the order in which they were put in.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace odolab {

// null, flag, number, text, array or object:
//   Json summary = Json::object();
//   summary["track"]["position_rms_m"] = 0.012;
//   summary["runs"].push_back(3);
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;

  Json() = default;  // null; becomes an object or an array by its first use as one
  template <std::same_as<bool> Flag>
  Json(Flag flag) : value_(flag) {}
  Json(double number) : value_(number) {}
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) Json(Integer number) {
    if constexpr (std::is_signed_v<Integer>)
      value_ = static_cast<std::int64_t>(number);
    else
      value_ = static_cast<std::uint64_t>(number);
  }
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <typename T>
  Json(const std::vector<T>& elements) : value_(Array(elements.begin(), elements.end())) {}

  static Json object() { return of(Object{}); }
  static Json array() { return of(Array{}); }

  Json& operator[](const std::string& key);  // added as null where it is absent
  Json& push_back(Json element);             // gives back the element as it stands in the array

 private:
  friend struct JsonWriter;
  template <typename T>
  static Json of(T value) {
    Json json;
    json.value_ = std::move(value);
    return json;
  }

  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object> value_ = nullptr;
};

// Readable text, indented, short arrays on one line. Numbers read back to the same bits; what is not finite is null.
// Bytes that are no UTF-8, as a file's name may have, become U+FFFD.
std::string to_text(const Json& value);

Result<Done> write_json(const std::string& path, const Json& value);

}  // namespace odolab
