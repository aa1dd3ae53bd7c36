#include "core/io/bag/ros_messages.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/exceptions/Exception.h>

namespace odolab {

namespace {

namespace cdr = eprosima::fastcdr;

// "nav_msgs/msg/Odometry" and "nav_msgs/Odometry" are the same type.
std::string_view package_of(std::string_view type) { return type.substr(0, type.find('/')); }
std::string_view name_of(std::string_view type) {
  const std::size_t at = type.rfind('/');
  return at == std::string_view::npos ? std::string_view() : type.substr(at + 1);
}
bool is(std::string_view type, std::string_view package, std::string_view name) {
  return package_of(type) == package && name_of(type) == name;
}

class Message {
 public:
  explicit Message(std::string_view bytes)
      : size_(bytes.size()), buffer_(const_cast<char*>(bytes.data()), bytes.size()) {
    cdr_.read_encapsulation();
  }

  // A sequence's length, which cannot be more than the bytes that are left for it.
  std::size_t length(std::size_t least_bytes_each) {
    std::uint32_t n = 0;
    cdr_ >> n;
    if (n > left() / least_bytes_each) throw cdr::exception::NotEnoughMemoryException("a length beyond the message");
    return n;
  }
  double number() {
    double value = 0.0;
    cdr_ >> value;
    return value;
  }
  void numbers(std::vector<double>& values) {
    values.resize(length(sizeof(double)));
    if (!values.empty()) cdr_.deserializeArray(values.data(), values.size());
  }
  void text(std::string& value) { cdr_ >> value; }
  std::int64_t time_ns() {
    std::int32_t seconds = 0;
    std::uint32_t nanoseconds = 0;
    cdr_ >> seconds >> nanoseconds;
    return static_cast<std::int64_t>(seconds) * 1'000'000'000 + nanoseconds;
  }
  void pose(RosPose& pose) {
    for (double* value : {&pose.x, &pose.y, &pose.z, &pose.qx, &pose.qy, &pose.qz, &pose.qw}) *value = number();
  }

 private:
  std::size_t left() const { return size_ - cdr_.getSerializedDataLength(); }

  std::size_t size_;
  cdr::FastBuffer buffer_;
  cdr::Cdr cdr_{buffer_, cdr::Cdr::DEFAULT_ENDIAN, cdr::Cdr::DDS_CDR};
};

// Plain CDR of either byte order: what rosbag2 keeps. Parameter lists and the second version of the encoding are not.
bool is_plain_cdr(std::string_view bytes) {
  return bytes.size() >= 4 && bytes[0] == 0 && (bytes[1] == 0 || bytes[1] == 1);
}

template <typename Read>
bool reads(std::string_view bytes, const Read& read) {
  if (!is_plain_cdr(bytes)) return false;
  try {
    Message message(bytes);
    read(message);
    return true;
  } catch (const cdr::exception::Exception&) {
    return false;
  }
}

}  // namespace

RosKind ros_kind(std::string_view type) {
  if (is(type, "sensor_msgs", "JointState")) return RosKind::joint_state;
  if (is(type, "nav_msgs", "Odometry") || is(type, "geometry_msgs", "PoseStamped") ||
      is(type, "geometry_msgs", "PoseWithCovarianceStamped"))
    return RosKind::pose;
  if (is(type, "geometry_msgs", "TransformStamped") || is(type, "tf2_msgs", "TFMessage")) return RosKind::transforms;
  if (is(type, "geometry_msgs", "Twist") || is(type, "geometry_msgs", "TwistStamped")) return RosKind::twist;
  return RosKind::other;
}

bool read_joint_state(std::string_view bytes, RosJointState& state) {
  return reads(bytes,
               [&](Message& message) {
                 state.stamp_ns = message.time_ns();
                 std::string frame;
                 message.text(frame);
                 state.names.resize(message.length(4));
                 for (std::string& name : state.names) message.text(name);
                 message.numbers(state.positions);
               }) &&
         (state.positions.empty() || state.positions.size() == state.names.size());
}

bool read_poses(std::string_view type, std::string_view bytes, std::vector<RosPose>& poses) {
  const bool with_child =
      name_of(type) == "Odometry" || name_of(type) == "TransformStamped" || name_of(type) == "TFMessage";
  return reads(bytes, [&](Message& message) {
    // a transform has a time, two names and seven numbers: 8 + 4 + 4 + 56 bytes or more
    poses.resize(name_of(type) == "TFMessage" ? message.length(72) : 1);
    for (RosPose& pose : poses) {
      pose.stamp_ns = message.time_ns();
      message.text(pose.frame);
      if (with_child)
        message.text(pose.child_frame);
      else
        pose.child_frame.clear();
      message.pose(pose);
    }
  });
}

bool read_twist(std::string_view type, std::string_view bytes, RosTwist& twist) {
  return reads(bytes, [&](Message& message) {
    twist.stamp_ns.reset();
    if (name_of(type) == "TwistStamped") {
      twist.stamp_ns = message.time_ns();
      std::string frame;
      message.text(frame);
    }
    twist.forward_mps = message.number();
    for (int i = 0; i < 4; ++i) message.number();  // sideways, up, roll and pitch
    twist.yaw_rate_radps = message.number();
  });
}

}  // namespace odolab
