// Each unit's own recording, as if it were a differential drive that the outside truth had followed.
#pragma once

#include <vector>

#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// The recorded truth as poses of the tracked point, headings unwrapped; without samples that repeat the one before to
// the bit, and without those that somebody drew into its gaps. Empty where it has no headings.
Track tracked_poses(const Recording& recording);
// The same of a truth whose headings are not looked at: they are zero.
Track tracked_positions(const Recording& recording);
bool comes_often(
    const Track& tracked);  // once a second, in the mean, or more: else it is too little to judge a unit by
// Of poses that do not come often each counts: the first and the last may be stamped half a second before and behind
// the encoders, where a vehicle stands; they are put at their first and last readings. `late_s`: the truth's clock.
Track few_poses(Track tracked, const std::vector<UnitSample>& samples, double late_s);

// The vehicle that a unit's recording is of: its drive, and the truth's mounting where the tracked point sits on it.
Vehicle vehicle_of_unit(const VehicleUnit& unit, const Vehicle& vehicle);

// `by_joints`: they say where the axle's middle was, on the encoders' clock; `clock_s` is the truth's offset in this
// recording. Else the truth stays as it was recorded, for the unit that carries it. `tracked`: see tracked_poses.
Recording recording_of_unit(const Recording& recording, const std::vector<UnitSample>& samples, const Track& tracked,
                            const Vehicle& vehicle, std::size_t unit, double clock_s, bool by_joints);

}  // namespace odolab
