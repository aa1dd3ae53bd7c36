// Recordings of other people's robots, brought into the shape that everything here starts from.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/recording/recording.h"

namespace odolab {

// A recording and what a person should know about how it came about, a sentence each.
struct ImportedRecording {
  Recording recording;
  std::vector<std::string> warnings;
};

// Finds out the format from names and content. One run is one file, or two where a format keeps wheels and truth apart
// (in either order; the second is found beside the first where its name says which it is).
Result<ImportedRecording> import_recording(const std::vector<std::string>& sources);

// Whether one of the known formats is recognised in this file.
bool is_foreign_recording(const std::string& path);

// A recording's own CSV, or a foreign file that import_recording understands.
Result<ImportedRecording> load_recording(const std::string& path);

}  // namespace odolab
