// What a bag file hands over, whatever the storage: topics, and their messages in the order of the file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace odolab {

struct BagTopic {
  std::string name;      // "/joint_states"
  std::string type;      // "sensor_msgs/msg/JointState"
  std::string encoding;  // "cdr"
};

// One message; `bytes` are valid during the call alone.
using BagSink = std::function<void(const BagTopic& topic, std::int64_t log_time_ns, std::string_view bytes)>;

// What the reader made of a file.
struct BagFileReading {
  std::vector<BagTopic> topics;     // all that the file describes, with or without messages
  std::vector<std::string> damage;  // what could not be read and why, a sentence each, without the file's name
};

}  // namespace odolab
