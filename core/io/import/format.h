// What each foreign format says about itself. A new format is one new file and one line in formats().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/import/imported_recording.h"

namespace odolab {

struct ForeignFormat {
  const char* name;
  const char* sources;  // what to give, for help and errors
  // From a file's path and its first bytes.
  bool (*recognises)(const std::string& path, std::string_view start);
  // All sources were recognised by this format.
  Result<ImportedRecording> (*read)(const std::vector<std::string>& sources);
};

const std::vector<ForeignFormat>& foreign_formats();

// The formats, one file each.
ForeignFormat optiodom_synchronised_format();
ForeignFormat optiodom_raw_format();
ForeignFormat mrclam_format();

}  // namespace odolab
