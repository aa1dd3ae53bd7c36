// A base that is known by its commands alone, reckoned in steps of half a millisecond: commands 50 times a second, each
// held until the next, and a truth of a millimetre at 100 Hz.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/recording/recording.h"

namespace odolab::test {

struct CommandedBase {
  static constexpr double kStep_s = 0.0005;
  double command_mps = 0.0, command_radps = 0.0;  // as logged
  double speed_mps = 0.0, yaw_rate_radps = 0.0;   // as it goes
  double heading_rad = 0.0;                       // as it stands
};

// `next`: what it is told, and makes of it, in each step.
inline Recording commanded(const std::string& name, int steps, Random& random,
                           const std::function<void(int step, CommandedBase&)>& next) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kStep_s = CommandedBase::kStep_s;
  Recording r;
  r.name = name;
  std::vector<double> speed, yaw_rate, x, y, heading;
  CommandedBase base;
  Pose pose;
  for (int i = 0; i < steps; ++i) {
    base.heading_rad = pose.heading_rad;
    next(i, base);
    if (i % 20 == 0) {
      r.time_s.push_back(kStep_s * i);
      speed.push_back(i % 40 == 0 ? base.command_mps : kNone);
      yaw_rate.push_back(i % 40 == 0 ? base.command_radps : kNone);
      x.push_back(pose.x_m + 0.001 * random.normal());
      y.push_back(pose.y_m + 0.001 * random.normal());
      heading.push_back(pose.heading_rad + 0.002 * random.normal());
    }
    const double v = base.speed_mps, w = base.yaw_rate_radps, middle = pose.heading_rad + 0.5 * w * kStep_s;
    // its wheels roll a little unevenly
    const double rolled = v * kStep_s + 0.0005 * std::sqrt(std::abs(v) * kStep_s) * random.normal();
    pose = {pose.x_m + rolled * std::cos(middle), pose.y_m + rolled * std::sin(middle),
            pose.heading_rad + w * kStep_s + 0.001 * std::sqrt(std::abs(v) * kStep_s) * random.normal()};
  }
  r.add_channel("command_speed_mps").values = speed;
  r.add_channel("command_yaw_rate_radps").values = yaw_rate;
  r.add_channel("truth_x_m").values = x;
  r.add_channel("truth_y_m").values = y;
  r.add_channel("truth_heading_rad").values = heading;
  return r;
}

}  // namespace odolab::test
