// A ROS 2 bag: one file, or the folder that `ros2 bag record` makes, which may hold several files of one run.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/io/bag/bag_message.h"
#include "core/io/bag/ros_messages.h"

namespace odolab {

// By its content, or by its ending where nothing was written into it yet; a folder by the bag files in it.
bool is_bag(const std::string& path);

// The files of a bag in the order in which they were recorded; one that is compressed as a whole only where the same is
// not there unpacked. An Error where there are none.
Result<std::vector<std::string>> bag_files(const std::string& path);

// Reads all files of a bag, one after the other. Topics are said once, damage with the file's name before it. Messages
// that were compressed one by one are handed over decompressed; files that were compressed as a whole are unpacked into
// the system's folder for temporary files while they are read. An Error where no file could be read at all.
Result<BagFileReading> read_bag(const std::string& path, const BagSink& sink, const Progress& progress = {});

// A transform of a tf2_msgs/TFMessage.
struct BagTransform {
  std::string parent, child;
  std::uint64_t messages = 0;
  RosPose last;
};

// What a topic holds.
struct BagTopicContents {
  BagTopic topic;
  RosKind kind = RosKind::other;  // `other` too where the encoding is not CDR
  std::uint64_t messages = 0;
  std::int64_t first_ns = 0, last_ns = 0;  // log times, the earliest and the latest
  std::vector<std::string> joints;         // of joint states, in the order in which they appear
  std::vector<BagTransform> transforms;    // each pair of frames once
};

struct BagContents {
  std::vector<BagTopicContents> topics;
  std::vector<std::string> damage;
};

// One pass over the bag that looks at names, and at the last of each transform.
Result<BagContents> contents_of_bag(const std::string& path, const Progress& progress = {});

}  // namespace odolab
