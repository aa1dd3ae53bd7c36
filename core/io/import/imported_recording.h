// Recordings of other people's robots, brought into the shape that everything here starts from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/io/import/import_wishes.h"
#include "core/recording/recording.h"

namespace odolab {

// A recording and what a person should know about how it came about, a sentence each.
struct ImportedRecording {
  Recording recording;
  std::vector<std::string> warnings;
};

// Finds out the format from names and content. One run is one file, or two where a format keeps wheels and truth apart
// (in either order; the second is found beside the first where its name says which it is).
// Sources that are read as streams (bags, text) may be given together where they share a clock. Recordings of
// our own and streams can be stopped by `progress`, here and below; the result is an Error then.
Result<ImportedRecording> import_recording(const std::vector<std::string>& sources, const ImportWishes& wishes = {},
                                           const Progress& progress = {});

// The same straight into a recording's CSV file, in memory that does not grow with streams.
struct ImportedFile {
  std::uint64_t rows = 0;
  double duration_s = 0.0;
  std::vector<std::string> channels;
  std::vector<std::string> warnings;
};
Result<ImportedFile> import_into_csv(const std::vector<std::string>& sources, const ImportWishes& wishes,
                                     const std::string& out, const Progress& progress = {});

// Whether one of the known formats is recognised in this file, or in this folder where a format is a folder.
bool is_foreign_recording(const std::string& path);

// A recording's own CSV, or a foreign file that import_recording understands.
Result<ImportedRecording> load_recording(const std::string& path, const Progress& progress = {});

}  // namespace odolab
