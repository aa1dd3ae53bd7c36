// The motion of a recording as a smooth function of time, so that a simulated base can be driven by it.
#pragma once

#include <vector>

#include "core/recording/recording.h"
#include "physics/wheel_pair.h"

namespace odolab {

// Wheel rotation between the samples of a recording. It passes through every sample with a continuous speed: a jump in
// wheel speed would be real slip.
class RecordedRotation {
 public:
  explicit RecordedRotation(std::vector<WheelSample> samples);

  bool empty() const { return samples_.empty(); }
  double first_s() const { return samples_.front().time_s; }
  double last_s() const { return samples_.back().time_s; }
  // Wheel speeds at a time, standing before the first and after the last sample.
  WheelPair speed_at(double time_s);
  // Rotation at a time; before the first and after the last sample the wheels stand. Times must be asked for in order.
  WheelPair at(double time_s);

 private:
  std::vector<WheelSample> samples_;
  std::vector<WheelPair> speeds_radps_;  // at the samples
  std::size_t segment_ = 0;
};

// Commands between the samples of a recording, each held until the next.
class RecordedCommands {
 public:
  explicit RecordedCommands(std::vector<CommandSample> samples) : samples_(std::move(samples)) {}

  bool empty() const { return samples_.empty(); }
  double first_s() const { return samples_.front().time_s; }
  double last_s() const { return samples_.back().time_s; }
  // Times must be asked for in order. Standing still before the first.
  CommandSample at(double time_s);

 private:
  std::vector<CommandSample> samples_;
  std::size_t next_ = 0;
};

}  // namespace odolab
