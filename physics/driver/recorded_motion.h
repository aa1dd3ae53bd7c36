// The motion of a recording as a smooth function of time, so that a simulated base can be driven by it.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Rotation of a vehicle's wheels between the samples of a recording. It passes through every sample with a continuous
// speed: a jump in wheel speed would be real slip.
class RecordedRotation {
 public:
  RecordedRotation() = default;
  // A row of all wheels for each time; times that do not grow replace the row before.
  RecordedRotation(const std::vector<double>& time_s, const std::vector<std::vector<double>>& rows_rad);

  bool empty() const { return time_s_.empty(); }
  double first_s() const { return time_s_.front(); }
  double last_s() const { return time_s_.back(); }
  // Wheel speeds at a time, standing before the first and after the last sample.
  std::vector<double> speed_at(double time_s);
  // Rotation at a time; before the first and after the last sample the wheels stand. Times must be asked for in order.
  std::vector<double> at(double time_s);

 private:
  std::vector<double> time_s_;
  std::vector<std::vector<double>> rows_rad_, speeds_radps_;  // at the samples
  std::size_t segment_ = 0;
};

// From a recording's columns for these motors; of a pair of wheels from its ticks as well, by the vehicle's counts a
// turn. Empty where the recording lacks them.
RecordedRotation recorded_rotation(const Recording& recording, const VehicleKind& kind,
                                   const std::vector<std::string>& channels);

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
