// What each foreign format says about itself. A new format is one new file and one line in formats().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/import/imported_recording.h"
#include "core/io/import/sample_streams.h"

namespace odolab {

struct ForeignFormat {
  const char* name;
  const char* sources;  // what to give, for help and errors
  // From a file's path and its first bytes.
  bool (*recognises)(const std::string& path, std::string_view start);
  // Either: all sources were recognised by this format.
  Result<ImportedRecording> (*read)(const std::vector<std::string>& sources);
  // Or: adds what one source holds to streams that others may add to.
  Result<Done> (*stream)(const std::string& source, const ImportWishes& wishes, SampleStreams& streams) = nullptr;
};

const std::vector<ForeignFormat>& foreign_formats();

// The formats, one file each.
ForeignFormat optiodom_synchronised_format();
ForeignFormat optiodom_raw_format();
ForeignFormat mrclam_format();
ForeignFormat ros2_bag_format();
ForeignFormat tum_format();
ForeignFormat kitti_format();
ForeignFormat mapped_text_format();

}  // namespace odolab
