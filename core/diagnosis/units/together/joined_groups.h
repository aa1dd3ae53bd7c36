// What may be wrong with a unit's motion, or with what a joint reads, whatever its name: columns for each, without one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

struct JoinedGroup {
  std::string component, words;  // "truck_b"; "turn per metre of truck B goes with yaw rate"
  std::function<JoinedColumns(const JoinedModel&)> columns;
  // Whether amplitudes are more than rounding makes; empty: any are.
  std::function<bool(const std::vector<double>& value)> is_more_than_rounding;
};

// Of each unit what goes with its speeds, its wheels' rotation, the time and so on (core/diagnosis/generic/groups.h),
// in each channel; of each joint's encoder an error that goes with what it reads, with which way it went, with how fast
// it turns, and with how hard its unit is pulled aside.
std::vector<JoinedGroup> joined_groups(const JoinedModel& model);
std::vector<JoinedGroup> groups_of_joints(const JoinedModel& model);  // those of the encoders alone

}  // namespace odolab
