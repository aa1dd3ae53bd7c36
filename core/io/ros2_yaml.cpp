#include "core/io/ros2_yaml.h"

#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

std::string ros2_diff_drive_yaml(const DifferentialDrive& nominal, const DifferentialDrive& calibrated) {
  const double radius_m = 0.5 * (nominal.wheel_radius_left_m + nominal.wheel_radius_right_m);
  const auto line = [](const char* key, double value) {
    // YAML takes "1" for a whole number, and ROS 2 then refuses it
    return std::string("    ") + key + ": " + decimal_text(value) + "\n";
  };
  return "# Calibrated by OdoLab. The controller multiplies: radius of a wheel = wheel_radius * its multiplier,\n"
         "# separation = wheel_separation * wheel_separation_multiplier (all in metres).\n"
         "diff_drive_controller:\n  ros__parameters:\n" +
         line("wheel_radius", radius_m) + line("wheel_separation", nominal.wheelbase_m) +
         line("left_wheel_radius_multiplier", calibrated.wheel_radius_left_m / radius_m) +
         line("right_wheel_radius_multiplier", calibrated.wheel_radius_right_m / radius_m) +
         line("wheel_separation_multiplier", calibrated.wheelbase_m / nominal.wheelbase_m);
}

Result<Done> write_ros2_diff_drive_yaml(const std::string& path, const DifferentialDrive& nominal,
                                        const DifferentialDrive& calibrated) {
  return write_whole_file(path, ros2_diff_drive_yaml(nominal, calibrated));
}

}  // namespace odolab
