// One run of a robot, real or simulated: what was read when, channel by channel. It is what every estimator starts
// from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/track.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// One column of a recording, a value for each row; NaN where the channel was not sampled at that time.
struct Channel {
  std::string name;  // the contract's name, unit and all: "left_wheel_rad", "truth_x_m"
  std::vector<double> values;
};

// Rows in order of time; the same shape as the CSV file it is kept in. Unknown channels are kept.
struct Recording {
  std::string name;        // usually the file's name
  std::string provenance;  // "simulated: …" or "real: …", for reports only; no computation looks at it
  std::vector<double> time_s;
  std::vector<Channel> channels;

  const Channel* channel(std::string_view name) const;  // null where there is none
  Channel& add_channel(std::string name);               // appended, all cells empty
  double duration_s() const { return time_s.empty() ? 0.0 : time_s.back() - time_s.front(); }
};

// Everything that makes a recording unusable, as sentences: columns of unequal length, time that goes back
// or jumps by more than a day, infinities.
std::vector<std::string> problems_in(const Recording& recording);

// Rotation of both drive wheels since the start.
struct WheelSample {
  double time_s = 0.0;
  double left_rad = 0.0;
  double right_rad = 0.0;
};

// Commanded motion, held until the next command.
struct CommandSample {
  double time_s = 0.0;
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

// An outside measurement of the pose; the heading may be missing.
struct TruthSample {
  double time_s = 0.0;
  Vec2 position;
  std::optional<double> heading_rad;
};

// Empty cells filled linearly between the neighbours that have a value; cells before the first and after the last stay.
void fill_between(const std::vector<double>& time_s, std::vector<double>& values);

// From left_wheel_rad and right_wheel_rad, or from left_ticks and right_ticks with the vehicle's counts per turn and
// wrap-around. Where one wheel was sampled at other times than the other, it is interpolated between its neighbours;
// not where it was read so seldom, or not for so long, that nobody knows how it went in between.
std::vector<WheelSample> wheel_samples(const Recording& recording, const DifferentialDrive& drive);
std::vector<CommandSample> command_samples(const Recording& recording);
// Headings come unwrapped.
std::vector<TruthSample> truth_samples(const Recording& recording);

// The truth as a track: only the samples that have a heading.
Track truth_track(const Recording& recording);

}  // namespace odolab
