// A differential drive as the parameters of ROS 2's diff_drive_controller (ros2_controllers).
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// YAML with `nominal` as wheel_radius (the mean of both) and wheel_separation, and what the calibration changed in the
// three multipliers, which is what they are for: the controller multiplies them into radius and separation.
std::string ros2_diff_drive_yaml(const DifferentialDrive& nominal, const DifferentialDrive& calibrated);

Result<Done> write_ros2_diff_drive_yaml(const std::string& path, const DifferentialDrive& nominal,
                                        const DifferentialDrive& calibrated);

}  // namespace odolab
