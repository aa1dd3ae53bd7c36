// The ROS 2 messages that a recording is made of, decoded from CDR (OMG, as ROS 2's middleware writes it): field by
// field in the order of their .msg files, either byte order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace odolab {

// sensor_msgs/JointState; velocities and efforts are not looked at.
struct RosJointState {
  std::int64_t stamp_ns = 0;
  std::vector<std::string> names;
  std::vector<double> positions;  // rad for a wheel; as many as names, or none
};

// A pose with what it is measured between: nav_msgs/Odometry, geometry_msgs/PoseStamped, PoseWithCovarianceStamped,
// TransformStamped, and each transform of a tf2_msgs/TFMessage.
struct RosPose {
  std::int64_t stamp_ns = 0;
  std::string frame, child_frame;  // the child is named by Odometry and transforms alone
  double x = 0.0, y = 0.0, z = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

// geometry_msgs/Twist, which has no stamp of its own, and TwistStamped.
struct RosTwist {
  std::optional<std::int64_t> stamp_ns;
  double forward_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

enum class RosKind { other, joint_state, pose, transforms, twist };

// By a type's name, "nav_msgs/msg/Odometry" or "nav_msgs/Odometry".
RosKind ros_kind(std::string_view type);

// Each reads one message of the given type and is false where the bytes are not one: too short, a size beyond the
// message, an encoding that is not plain CDR. What was read into is then of no use. The structs may be used again.
bool read_joint_state(std::string_view bytes, RosJointState& message);
bool read_poses(std::string_view type, std::string_view bytes, std::vector<RosPose>& poses);
bool read_twist(std::string_view type, std::string_view bytes, RosTwist& message);

}  // namespace odolab
