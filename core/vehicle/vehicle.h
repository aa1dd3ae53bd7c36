// A vehicle as its TOML file describes it: one of the kinds, and where the outside truth sits on it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/pose.h"
#include "core/vehicle/clapper.h"
#include "core/vehicle/differential_drive.h"
#include "core/vehicle/encoder_trailer.h"
#include "core/vehicle/multi_castor.h"
#include "core/vehicle/omnimate.h"
#include "core/vehicle/smart_encoder_trailer.h"
#include "core/vehicle/synchro_drive.h"
#include "core/vehicle/tracked.h"

namespace odolab {

// How an outside measurement of the pose relates to the axle's centre; of linked trucks truck A's, of a vehicle with a
// trailer the towing vehicle's, of a multi-castor vehicle the body's origin.
struct TruthMounting {
  Pose axle_T_tracked;         // the tracked point and its heading in the frame of the axle's centre
  double time_offset_s = 0.0;  // positive: the truth's stamps are late
  bool is_reckoned = false;    // by what other wheels turned: nobody measured it, or filled its gaps
};

// A new kind is one file beside this one, one type here, one list of fields in core/io/vehicle_toml.cpp.
using VehicleKind = std::variant<DifferentialDrive, SynchroDrive, Tracked, Clapper, OmniMate, EncoderTrailer,
                                 SmartEncoderTrailer, MultiCastor>;

struct Vehicle {
  std::string name = "LabMate";
  VehicleKind kind;
  TruthMounting truth;
};

// The vehicle file's word for it: "differential_drive".
std::string kind_name(const Vehicle& vehicle);

std::vector<std::string> problems_in(const VehicleKind& kind);

// For what works on a differential drive alone: "kind: found 'clapper', expected 'differential_drive', …". None where
// the vehicle is one. `what` completes "expected 'differential_drive', the only kind that ".
std::optional<Error> other_than_differential_drive(const Vehicle& vehicle, const std::string& what);

}  // namespace odolab
