// What a file is, by what stands in it.
#pragma once

#include <string>

#include "core/base/result.h"

namespace odolab {

enum class FileKind { scenario, vehicle, lesson, guide, recording, foreign_recording, unknown };

// Looks at the beginning alone, so that a broken file is still taken for what it was meant to be. A TOML file with a
// key `kind` at its top is a vehicle, with `lesson` a lesson, with a guide's `schema` a guide's session, another one a
// scenario; a CSV file whose header names `time_s` is a recording.
FileKind file_kind(const std::string& path);

// What is wrong with a file that could not be read as what was wanted: that it is plainly something else, else `error`.
Error or_another_kind(const Error& error, const std::string& path, FileKind wanted);

}  // namespace odolab
