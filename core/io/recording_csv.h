// A recording as a CSV file: a header line with the contract's column names, then rows in time order.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace odolab {

// Whether a column's name is one of those that recordings define; others are kept, and what is no number there is
// empty.
bool is_recording_column(std::string_view name);

// A column that says nothing without another (a left wheel without the right one), and that other.
std::optional<std::pair<std::string, std::string>> without_partner(const std::vector<std::string>& names);

// Errors name file, line and column, what was found and what was expected. The recording takes the file's name. Where
// `progress` says stop the result is an Error.
enum class AllowedValues { any, of_a_robot };  // of_a_robot: one beyond `largest_value` is an error
Result<Recording> read_recording_csv(const std::string& path, const Progress& progress = {},
                                     AllowedValues values = AllowedValues::any);

// Numbers read back to the same bits. A recording with problems is not written.
Result<Done> write_recording_csv(const std::string& path, const Recording& recording);

}  // namespace odolab
