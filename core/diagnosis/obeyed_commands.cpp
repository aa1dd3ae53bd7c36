#include "core/diagnosis/obeyed_commands.h"

#include <algorithm>

namespace odolab {

Recording with_obeyed_commands(Recording recording, const Vehicle& file, const Vehicle& fitted) {
  const auto *drawn = std::get_if<DifferentialDrive>(&file.kind), *real = std::get_if<DifferentialDrive>(&fitted.kind);
  const auto values = [&](const char* name) -> std::vector<double>* {
    const auto found = std::find_if(recording.channels.begin(), recording.channels.end(),
                                    [&](const Channel& c) { return c.name == name; });
    return found == recording.channels.end() ? nullptr : &found->values;
  };
  std::vector<double>*speed_mps = values("command_speed_mps"), *yaw_rate_radps = values("command_yaw_rate_radps");
  if (!drawn || !real || !speed_mps || !yaw_rate_radps || wheel_samples(recording, *drawn).size() >= 2)
    return recording;
  const double left = real->wheel_radius_left_m / drawn->wheel_radius_left_m,
               right = real->wheel_radius_right_m / drawn->wheel_radius_right_m;
  if (left == 1.0 && right == 1.0 && real->wheelbase_m == drawn->wheelbase_m) return recording;  // to the bit
  for (std::size_t i = 0; i < speed_mps->size(); ++i) {
    double &v = (*speed_mps)[i], &w = (*yaw_rate_radps)[i];
    const double left_mps = left * (v - 0.5 * drawn->wheelbase_m * w),
                 right_mps = right * (v + 0.5 * drawn->wheelbase_m * w);
    v = 0.5 * (left_mps + right_mps);
    w = (right_mps - left_mps) / real->wheelbase_m;
  }
  return recording;
}

}  // namespace odolab
