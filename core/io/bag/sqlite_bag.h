// rosbag2's sqlite3 storage (.db3): tables `topics` and `messages`.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/io/bag/bag_message.h"

namespace odolab {

bool starts_like_sqlite(std::string_view start);

// Opens the file for reading alone and hands its messages over in the order in which they were stored. Where the file
// is cut or damaged, what SQLite can still read; an Error where it has no such tables.
Result<BagFileReading> read_sqlite_bag(const std::string& path, const BagSink& sink, const Progress& progress = {});

}  // namespace odolab
