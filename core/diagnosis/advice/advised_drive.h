// The drives that advice chooses from: short, of many kinds, each at two or three speeds that the vehicle has shown.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Speeds that are held for a while.
struct DriveLeg {
  double duration_s = 0.0;
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

struct AdvisedDrive {
  std::string sentence;  // "arcs of 0.5 m radius, both ways, at 0.15 and 0.4 m/s"
  std::vector<DriveLeg> legs;

  double duration_s() const;
};

// How fast a vehicle drives, as its recordings show.
struct DrivingRange {
  double speed_mps = 0.4, yaw_rate_radps = 1.5;
  double acceleration_mps2 = 0.4, yaw_acceleration_radps2 = 2.0;
};

// Straights there and back, squares, arcs, turns on the spot, figures of eight, starts and stops, reversals.
std::vector<AdvisedDrive> advised_drives(const DrivingRange& range);

// A manoeuvre as this drive would record it without noise, its truth at that period, with headings or without.
InnovationRun run_of(const AdvisedDrive& manoeuvre, const DrivingRange& range, const DifferentialDrive& drive,
                     double truth_period_s, bool truth_has_heading);

}  // namespace odolab
