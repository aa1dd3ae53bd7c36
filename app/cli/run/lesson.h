// A lesson without a window: every step is driven, and judged as the lesson expects.
#pragma once

#include <string>

namespace odolab {

// Returns an exit code. Where `out` is not empty, what each step leaves goes into summary.json in that folder.
int run_lesson(const std::string& path, const std::string& out, bool check);

}  // namespace odolab
