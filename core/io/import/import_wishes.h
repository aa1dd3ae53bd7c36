// What a person says about a source where it does not say it by itself.
#pragma once

#include <optional>
#include <string>

#include "core/io/import/text_mapping.h"

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
  std::optional<SpaceAxes> axes;        // z up where nobody says so and the format has no habit of its own
  TextMapping mapping;                  // of text in which the columns have no meaning that is known
  std::string times;                    // the file of the times of KITTI poses
};

}  // namespace odolab
