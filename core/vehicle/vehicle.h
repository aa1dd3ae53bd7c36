// A vehicle as its TOML file describes it: one of the kinds, and where the outside truth sits on it.
#pragma once

#include <string>
#include <variant>

#include "core/geometry/pose.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// How an outside measurement of the pose relates to the axle's centre.
struct TruthMounting {
  Pose axle_T_tracked;         // the tracked point and its heading in the frame of the axle's centre
  double time_offset_s = 0.0;  // positive: the truth's stamps are late
};

struct Vehicle {
  std::string name = "LabMate";
  std::variant<DifferentialDrive> kind;
  TruthMounting truth;
};

}  // namespace odolab
