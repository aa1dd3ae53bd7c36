// What a person says about a source where it does not say it by itself.
#pragma once

#include <string>

namespace odolab {

// Which way the axes of poses in space point; how they lie on the floor follows from it.
enum class SpaceAxes {
  z_up,    // as in ROS and most trackers: x, y on the floor
  y_up,    // as Motive exports: x, minus z on the floor
  camera,  // z ahead, x right, y down: z, minus x on the floor
};

// Empty where the source is plain.
struct ImportWishes {
  std::string wheels;                   // topic of joint states
  std::string left_joint, right_joint;  // names of the drive wheels' joints
  std::string commands;                 // topic of twists; "none": leave them out
  std::string truth;                    // topic of poses, or TOPIC:PARENT:CHILD of transforms; "none"
  SpaceAxes axes = SpaceAxes::z_up;
};

}  // namespace odolab
