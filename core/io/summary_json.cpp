#include "core/io/summary_json.h"

#include <cassert>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/valid_utf8.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

Json& Json::operator[](const std::string& key) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object{};
  assert(std::holds_alternative<Object>(value_));
  Object& object = std::get<Object>(value_);
  for (auto& entry : object)
    if (entry.first == key) return entry.second;
  object.emplace_back(key, Json());
  return object.back().second;
}

Json& Json::push_back(Json element) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Array{};
  assert(std::holds_alternative<Array>(value_));
  Array& array = std::get<Array>(value_);
  array.push_back(std::move(element));
  return array.back();
}

struct JsonWriter {
  std::string text;
  int depth = 0;

  void write(const Json& json) {
    std::visit([this](const auto& value) { put(value); }, json.value_);
  }

  void put(std::nullptr_t) { text += "null"; }
  void put(bool flag) { text += flag ? "true" : "false"; }
  void put(std::int64_t number) { text += std::to_string(number); }
  void put(std::uint64_t number) { text += std::to_string(number); }

  void put(double number) {
    if (!std::isfinite(number)) return put(nullptr);
    const std::size_t begin = text.size();
    append_number(text, number);
    if (text.find_first_of(".e", begin) == std::string::npos) text += ".0";
  }

  void put(const std::string& value) {
    text += '"';
    for (char c : valid_utf8(value)) {
      if (c == '"' || c == '\\') {
        text += '\\';
        text += c;
      } else if (c == '\n') {
        text += "\\n";
      } else if (static_cast<unsigned char>(c) < 0x20) {
        text += formatted("\\u%04x", static_cast<unsigned>(c));
      } else {
        text += c;
      }
    }
    text += '"';
  }

  void put(const Json::Array& array) {
    bool short_one = array.size() <= 8;
    for (const Json& element : array) short_one = short_one && is_short(element);
    if (short_one) {
      text += '[';
      for (std::size_t i = 0; i < array.size(); ++i) {
        if (i) text += ", ";
        write(array[i]);
      }
      text += ']';
      return;
    }
    text += '[';
    ++depth;
    for (std::size_t i = 0; i < array.size(); ++i) {
      new_line(i);
      write(array[i]);
    }
    --depth;
    new_line(0);
    text += ']';
  }

  void put(const Json::Object& object) {
    if (object.empty()) {
      text += "{}";
      return;
    }
    text += '{';
    ++depth;
    for (std::size_t i = 0; i < object.size(); ++i) {
      new_line(i);
      put(object[i].first);
      text += ": ";
      write(object[i].second);
    }
    --depth;
    new_line(0);
    text += '}';
  }

  void new_line(std::size_t elements_before) {
    text += elements_before ? ",\n" : "\n";
    text.append(static_cast<std::size_t>(2 * depth), ' ');
  }

  // A scalar, or a pair or so of numbers as in an interval.
  static bool is_short(const Json& json) {
    if (const auto* array = std::get_if<Json::Array>(&json.value_)) {
      for (const Json& element : *array)
        if (std::holds_alternative<Json::Array>(element.value_) || !is_short(element)) return false;
      return array->size() <= 3;
    }
    return !std::holds_alternative<Json::Object>(json.value_);
  }
};

std::string to_text(const Json& value) {
  JsonWriter writer;
  writer.write(value);
  return writer.text + "\n";
}

Result<Done> write_json(const std::string& path, const Json& value) { return write_whole_file(path, to_text(value)); }

}  // namespace odolab
