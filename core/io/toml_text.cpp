#include "core/io/toml_text.h"

#include "core/base/formatted.h"
#include "core/base/valid_utf8.h"
#include "core/io/number_text.h"

namespace odolab {

namespace {

// A number that TOML takes for a float.
std::string float_text(double value) {
  std::string text = number_text(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string quoted_text(const std::string& value) {
  std::string text = "\"";
  for (char c : valid_utf8(value)) {
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (c == '\n') {
      text += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      text += formatted("\\u%04X", static_cast<unsigned>(c));
    } else {
      text += c;
    }
  }
  return text + "\"";
}

}  // namespace

void TomlText::comment(const std::string& text) { text_ += "# " + valid_utf8(text) + "\n"; }
void TomlText::table(const std::string& path) { text_ += (text_.empty() ? "[" : "\n[") + path + "]\n"; }
void TomlText::table_element(const std::string& path) { text_ += (text_.empty() ? "[[" : "\n[[") + path + "]]\n"; }

void TomlText::field(const char* key, double value) { text_ += std::string(key) + " = " + float_text(value) + "\n"; }
void TomlText::field(const char* key, int value) { text_ += std::string(key) + " = " + std::to_string(value) + "\n"; }
void TomlText::field(const char* key, std::uint64_t value) {
  text_ += std::string(key) + " = " + std::to_string(value) + "\n";
}
void TomlText::field(const char* key, bool value) { text_ += std::string(key) + (value ? " = true\n" : " = false\n"); }
void TomlText::field(const char* key, const std::string& value) {
  text_ += std::string(key) + " = " + quoted_text(value) + "\n";
}

void TomlText::field(const char* key, const std::optional<double>& value) {
  if (value) field(key, *value);
}

void TomlText::field(const char* key, const std::vector<double>& values) {
  text_ += std::string(key) + " = [";
  for (std::size_t i = 0; i < values.size(); ++i) text_ += (i ? ", " : "") + float_text(values[i]);
  text_ += "]\n";
}

void TomlText::field(const char* key, const std::vector<Vec2>& points) {
  text_ += std::string(key) + " = [";
  for (std::size_t i = 0; i < points.size(); ++i)
    text_ += (i ? ", [" : "[") + float_text(points[i].x_m) + ", " + float_text(points[i].y_m) + "]";
  text_ += "]\n";
}

}  // namespace odolab
