// Two trucks on a compliant link whose angles and length are measured: what the CLAPPER and the OmniMate have in
// common.
#pragma once

#include <string>
#include <vector>

#include "core/vehicle/differential_drive.h"

namespace odolab {

// What odometry needs to know of two linked trucks; the link ends at the axles' centres. Truck A leads. The link's
// heading is the direction from B to A; its angle at a truck is the truck's heading minus that: both are zero in a
// straight train. The defaults are two LabMates with the encoders of the CLAPPER paper (J. Borenstein 1995): 0.3
// degrees, 0.1 mm; the length of the link is ours.
struct LinkedTrucks {
  DifferentialDrive truck_a;
  DifferentialDrive truck_b;
  double link_length_m = 1.0;                 // nominal; the linear encoder measures the real one
  double link_angle_resolution_rad = 0.0052;  // of both absolute rotary encoders; 0: continuous
  double link_length_resolution_m = 0.0001;   // of the linear encoder; 0: continuous
  double link_angle_a_offset_rad = 0.0;       // reading minus truth
  double link_angle_b_offset_rad = 0.0;
  double link_length_offset_m = 0.0;
};

// The trucks' encoders are alike: problems where their counts differ.
std::vector<std::string> problems_in(const LinkedTrucks& vehicle);

}  // namespace odolab
