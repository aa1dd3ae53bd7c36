// Each unit's own recording, as if it were a differential drive that the outside truth had followed.
#pragma once

#include <vector>

#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// The vehicle that a unit's recording is of: its drive, and the truth's mounting where the tracked point sits on it.
Vehicle vehicle_of_unit(const VehicleUnit& unit, const Vehicle& vehicle);

// `by_joints`: they say where the axle's middle was, on the encoders' clock; `clock_s` is the truth's offset in this
// recording. Else the truth stays as it was recorded, for the unit that carries it. `tracked`: see outside_truth.h.
Recording recording_of_unit(const Recording& recording, const std::vector<UnitSample>& samples, const Track& tracked,
                            const Vehicle& vehicle, std::size_t unit, double clock_s, bool by_joints);

}  // namespace odolab
