// Every estimator that a vehicle allows, to run side by side along the same readings. Each takes the same steps as the
// estimators of whole recordings in this folder, and ends with the same bits.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

class RunningEstimator {
 public:
  virtual ~RunningEstimator() = default;
  // The readings of all the vehicle's encoders at a time, in the order of encoder_channels. The first ones begin it.
  virtual void take(double time_s, const std::vector<double>& readings) = 0;
  virtual Pose pose() const = 0;  // of the point that the truth measures, mounting aside
};

struct Estimator {
  std::string name;   // "IPEC", "CAST-2"
  std::string about;  // what it does, and its source
  std::function<std::unique_ptr<RunningEstimator>(const Pose& start)> begin;
};

// The first is the one that predicts a recording's track; nothing in the list refers to `kind` later.
std::vector<Estimator> estimators_for(const VehicleKind& kind);

// Which of them a vehicle steers by, with internal correction (IPEC) or without.
std::size_t steering_estimator(const VehicleKind& kind, bool internal_correction);

// The recording's columns that a vehicle of this kind fills.
std::vector<std::string> encoder_channels(const VehicleKind& kind);

}  // namespace odolab
