// A tracked vehicle: two tracks that skid when it turns.
#pragma once

#include <string>
#include <vector>

#include "core/vehicle/differential_drive.h"

namespace odolab {

// What odometry needs to know of a tracked vehicle. The encoders sit on the sprockets that drive the tracks. The
// defaults are a Remotec Andros's in kind; the UMBmark report gives no dimensions.
struct Tracked {
  static constexpr const char* kKind = "tracked";

  double sprocket_radius_left_m = 0.10;  // to the middle of the track: travel of the track for each radian
  double sprocket_radius_right_m = 0.10;
  double track_width_m = 0.50;  // between the tracks' middles
  // How much wider the vehicle seems when it turns, because the tracks slip: 1 as wide as it is.
  double slip_factor = 1.0;
  double encoder_counts_per_revolution = 2000.0;
  double gear_ratio = 1.0;
  int counter_bits = 0;
  bool counts_are_assumed = false;
};

std::vector<std::string> problems_in(const Tracked& vehicle);

// The differential drive whose dead reckoning is this vehicle's.
DifferentialDrive as_differential_drive(const Tracked& vehicle);

}  // namespace odolab
