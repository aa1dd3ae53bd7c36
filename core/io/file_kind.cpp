#include "core/io/file_kind.h"

#include <string_view>

#include "core/io/import/imported_recording.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

bool is_name(std::string_view text) {
  for (char c : text)
    if (!(c == '_' || c == '-' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
          (c >= 'A' && c <= 'Z')))
      return false;
  return !text.empty();
}

// Whatever is TOML and nothing else is taken for a scenario, as may be a vehicle that lacks its kind.
bool has_table_of_a_scenario(const std::string& path) {
  const std::string start = "\n" + read_file_start(path, 65536);
  for (const char* table : {"\n[path]", "\n[driving]", "\n[sensors]", "\n[[expect]]", "\nvehicle ="})
    if (start.find(table) != std::string::npos) return true;
  return false;
}

std::string kind_in_words(FileKind kind) {
  switch (kind) {
    case FileKind::scenario:
      return "a scenario's file";
    case FileKind::vehicle:
      return "a vehicle's file";
    case FileKind::lesson:
      return "a lesson's file";
    case FileKind::guide:
      return "a guide's session";
    case FileKind::recording:
    case FileKind::foreign_recording:
      return "a recording";
    case FileKind::unknown:
      break;
  }
  return "another file";
}

}  // namespace

FileKind file_kind(const std::string& path) {
  const std::string start = read_file_start(path, 65536);
  std::string_view rest = start;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
  if (trimmed(rest.substr(0, rest.find('\n'))).find("time_s") != std::string_view::npos &&
      rest.substr(0, rest.find('\n')).find('=') == std::string_view::npos)
    return FileKind::recording;
  if (is_foreign_recording(path)) return FileKind::foreign_recording;
  bool is_toml = path.ends_with(".toml") && !start.empty();
  while (!rest.empty()) {
    const std::size_t size = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, size));
    rest.remove_prefix(size == std::string_view::npos ? rest.size() : size + 1);
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[') {
      is_toml = is_toml || line.find(']') != std::string_view::npos;
      break;  // the top's own keys end here
    }
    const std::string_view key = trimmed(line.substr(0, line.find('=')));
    if (line.find('=') == std::string_view::npos || !is_name(key)) continue;
    if (key == "kind") return FileKind::vehicle;
    if (key == "lesson") return FileKind::lesson;
    if (key == "schema" && line.find("odolab.guide") != std::string_view::npos) return FileKind::guide;
    is_toml = true;
  }
  if (is_toml) return FileKind::scenario;
  return path.ends_with(".csv") && !start.empty() ? FileKind::recording : FileKind::unknown;
}

Error or_another_kind(const Error& error, const std::string& path, FileKind wanted) {
  const FileKind kind = file_kind(path);
  const bool is_another =
      kind != wanted && kind != FileKind::unknown && (kind != FileKind::scenario || has_table_of_a_scenario(path));
  return is_another ? Error{path, kind_in_words(kind), kind_in_words(wanted)} : error;
}

}  // namespace odolab
