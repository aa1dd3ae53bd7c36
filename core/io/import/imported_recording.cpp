#include "core/io/import/imported_recording.h"

#include <algorithm>
#include <filesystem>

#include "core/io/import/format.h"
#include "core/io/number_text.h"
#include "core/io/recording_csv.h"
#include "core/io/whole_file.h"

namespace odolab {

const std::vector<ForeignFormat>& foreign_formats() {
  static const std::vector<ForeignFormat> formats = {
      optiodom_synchronised_format(),
      optiodom_raw_format(),
      mrclam_format(),
  };
  return formats;
}

namespace {

namespace fs = std::filesystem;

const ForeignFormat* format_of(const std::string& path) {
  const std::string start = read_file_start(path);
  for (const ForeignFormat& format : foreign_formats())
    if (format.recognises(path, start)) return &format;
  return nullptr;
}

// Whether the first line names a column time_s.
bool has_recording_header(const std::string& path) {
  const std::string start = read_file_start(path);
  return start.substr(0, start.find('\n')).find("time_s") != std::string::npos;
}

Error folder_given(const std::string& path) {
  std::vector<std::string> usable;
  std::error_code failure;
  for (fs::recursive_directory_iterator at(path, failure), end; at != end && usable.size() < 1000;
       at.increment(failure)) {
    const std::string file = at->path().string();
    if (at->is_regular_file(failure) && (has_recording_header(file) || format_of(file))) usable.push_back(file);
  }
  std::sort(usable.begin(), usable.end());
  if (usable.empty()) return {path, "a folder without recordings", "the file of a run"};
  return {
      path,
      "a folder with " + std::to_string(usable.size()) + (usable.size() == 1 ? " file" : " files") + " of recordings",
      "one run, such as " + in_quotes(fs::path(usable.front()).lexically_relative(path).string())};
}

std::string known_formats() {
  std::string text = "a recording CSV";
  for (const ForeignFormat& format : foreign_formats())
    text += std::string(&format == &foreign_formats().back() ? " or " : ", ") + format.sources;
  return text;
}

}  // namespace

bool is_foreign_recording(const std::string& path) { return format_of(path) != nullptr; }

Result<ImportedRecording> import_recording(const std::vector<std::string>& sources) {
  if (sources.empty()) return Error{"import", "no source", known_formats()};
  const ForeignFormat* format = nullptr;
  for (const std::string& source : sources) {
    std::error_code failure;
    if (fs::is_directory(source, failure)) return folder_given(source);
    if (!fs::exists(source, failure)) return Error{source, "no such file", "a file that can be read"};
    const ForeignFormat* of_this = format_of(source);
    if (!of_this && sources.size() == 1 && has_recording_header(source)) {
      Result<Recording> recording = read_recording_csv(source);
      if (!recording) return recording.error();
      return ImportedRecording{std::move(*recording), {}};
    }
    if (!of_this) return Error{source, "a file of no known format", known_formats()};
    if (format && of_this != format)
      return Error{source, std::string("a file of ") + of_this->name,
                   std::string("one of ") + format->name + " as the first source"};
    format = of_this;
  }
  return format->read(sources);
}

Result<ImportedRecording> load_recording(const std::string& path) {
  if (is_foreign_recording(path)) return import_recording({path});
  std::error_code failure;
  if (fs::is_directory(path, failure)) return folder_given(path);
  Result<Recording> recording = read_recording_csv(path);
  if (!recording) return recording.error();
  return ImportedRecording{std::move(*recording), {}};
}

}  // namespace odolab
