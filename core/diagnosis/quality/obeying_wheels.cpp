#include "core/diagnosis/quality/obeying_wheels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace odolab {

namespace {

constexpr double kEmpty = std::numeric_limits<double>::quiet_NaN();

// Between one sample and the next, evenly.
std::vector<WheelSample> evenly_between(const WheelSample& a, const WheelSample& b) {
  constexpr double kLongest_s = 0.01, kMostParts = 4000.0, kRounding = 1e-6;
  const double lasts_s = b.time_s - a.time_s, parts = std::min(kMostParts, std::ceil(lasts_s / kLongest_s - kRounding));
  std::vector<WheelSample> all;
  for (double part = 1.0; part < parts; ++part) {
    const double u = part / parts;
    all.push_back({a.time_s + u * lasts_s, a.left_rad + u * (b.left_rad - a.left_rad),
                   a.right_rad + u * (b.right_rad - a.right_rad)});
  }
  return all;
}

}  // namespace

std::vector<WheelSample> obeying_wheels(const std::vector<CommandSample>& commands, const DifferentialDrive& drive) {
  std::vector<WheelSample> wheels;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    WheelSample next{commands[i].time_s, 0.0, 0.0};
    if (i > 0) {
      const CommandSample& held = commands[i - 1];
      const double lasts_s = commands[i].time_s - held.time_s,
                   by_turn_mps = 0.5 * drive.wheelbase_m * held.yaw_rate_radps;
      next.left_rad = wheels.back().left_rad + (held.speed_mps - by_turn_mps) * lasts_s / drive.wheel_radius_left_m;
      next.right_rad = wheels.back().right_rad + (held.speed_mps + by_turn_mps) * lasts_s / drive.wheel_radius_right_m;
    }
    wheels.push_back(next);
  }
  return wheels;
}

bool has_commands_alone(const Recording& recording, const std::vector<WheelSample>& wheels) {
  return wheels.size() < 2 && recording.channel("command_speed_mps") && recording.channel("command_yaw_rate_radps");
}

Recording with_obeying_wheels(const Recording& recording, const DifferentialDrive& drive) {
  const std::vector<WheelSample> wheels = obeying_wheels(command_samples(recording), drive);
  std::vector<WheelSample> all;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    all.push_back(wheels[i]);
    if (i + 1 == wheels.size()) break;
    const std::vector<WheelSample> held = evenly_between(wheels[i], wheels[i + 1]);
    all.insert(all.end(), held.begin(), held.end());
  }
  const Channel &speed = *recording.channel("command_speed_mps"),
                &yaw_rate = *recording.channel("command_yaw_rate_radps");
  Recording out{recording.name, recording.provenance, {}, {}};
  std::vector<std::size_t> from;  // the row of the recording, or none
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  Channel left{"left_wheel_rad", {}}, right{"right_wheel_rad", {}};
  const auto add_row = [&](double time_s, std::size_t row, const WheelSample* wheel) {
    out.time_s.push_back(time_s);
    from.push_back(row);
    left.values.push_back(wheel ? wheel->left_rad : kEmpty);
    right.values.push_back(wheel ? wheel->right_rad : kEmpty);
  };
  std::size_t next = 0;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    const bool commanded = !std::isnan(speed.values[i]) && !std::isnan(yaw_rate.values[i]);
    for (; next < all.size() && all[next].time_s < recording.time_s[i]; ++next)
      add_row(all[next].time_s, kNone, &all[next]);
    add_row(recording.time_s[i], i, commanded ? &all[next++] : nullptr);
  }
  for (const Channel& channel : recording.channels) {
    if (channel.name == left.name || channel.name == right.name) continue;
    Channel& kept = out.channels.emplace_back(Channel{channel.name, {}});
    for (const std::size_t row : from) kept.values.push_back(row == kNone ? kEmpty : channel.values[row]);
  }
  out.channels.push_back(std::move(left));
  out.channels.push_back(std::move(right));
  return out;
}

}  // namespace odolab
