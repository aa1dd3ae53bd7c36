// CDR messages; the first byte chooses the type that they are taken for.
#include <cstdint>

#include "core/io/bag/ros_messages.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr const char* kTypes[] = {"nav_msgs/msg/Odometry",
                                           "geometry_msgs/msg/PoseStamped",
                                           "geometry_msgs/msg/PoseWithCovarianceStamped",
                                           "geometry_msgs/msg/TransformStamped",
                                           "tf2_msgs/msg/TFMessage",
                                           "geometry_msgs/msg/Twist",
                                           "geometry_msgs/msg/TwistStamped",
                                           "sensor_msgs/msg/JointState"};
  if (size < 1) return 0;
  const char* type = kTypes[data[0] % 8];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  odolab::RosJointState joints;
  odolab::RosTwist twist;
  std::vector<odolab::RosPose> poses;
  if (data[0] % 8 == 7)
    odolab::read_joint_state(bytes, joints);
  else if (data[0] % 8 >= 5)
    odolab::read_twist(type, bytes, twist);
  else
    odolab::read_poses(type, bytes, poses);
  return 0;
}
