// MCAP files (mcap.dev/spec, version 0): the storage of ROS 2 bags today. Plain, zstd and lz4 chunks, with and without
// an index; checksums are verified where they are given. Sizes and offsets are never trusted.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/io/bag/bag_message.h"

namespace odolab {

bool starts_like_mcap(std::string_view start);

// Reads the file once from front to back; memory is that of its largest chunk. An unfinished file is read up to its
// last whole record; a damaged chunk is left out, and after a damaged record reading goes on at the next chunk that the
// index knows. An Error only where nothing of the file can be read as MCAP.
Result<BagFileReading> read_mcap(const std::string& path, const BagSink& sink, const Progress& progress = {});

}  // namespace odolab
