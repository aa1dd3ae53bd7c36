// The outside truth of a vehicle with units, and what there is of it.
#pragma once

#include <vector>

#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// The recorded truth as poses of the tracked point, headings unwrapped; without samples that repeat the one before to
// the bit, and without those that somebody drew into its gaps. Empty where it has no headings.
Track tracked_poses(const Recording& recording);
// The same of a truth whose headings are not looked at: they are zero.
Track tracked_positions(const Recording& recording);
// Without samples that come sooner after the one before.
Track at_least_apart(const Track& tracked, double step_s);
// Once a second, in the mean, or more: else it is too little to judge a unit by.
bool comes_often(const Track& tracked);
// Of poses that do not come often each counts: the first and the last may be stamped half a second before and behind
// the encoders, where a vehicle stands; they are put at their first and last readings. `late_s`: the truth's clock.
Track few_poses(Track tracked, const std::vector<UnitSample>& samples, double late_s);

// What every recording has, the best first: poses that come often, of those that are fitted on; places that do; poses
// at both ends or a few more; or nothing to judge a vehicle by.
enum class OutsideTruth { poses, positions, ends, nothing };
OutsideTruth outside_truth(const std::vector<Recording>& train, const std::vector<Recording>& held_out);

}  // namespace odolab
