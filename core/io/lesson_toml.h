// A lesson as a TOML file. assets/lessons/README.md lists the keys.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/lesson/lesson.h"

namespace odolab {

// Reads a lesson, the scenarios in it and those that it names. Errors name file and line or key; a lesson that comes
// back has no problems.
Result<Lesson> read_lesson(const std::string& path);

}  // namespace odolab
