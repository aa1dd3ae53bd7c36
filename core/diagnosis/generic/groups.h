// What a mismatch may depend on: variables of what the vehicle does, did and where it is, each with functions of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Functions of one variable: hats on its quantiles, harmonics, polynomials or what fades.
struct Group {
  std::string variable;
  std::vector<double> at;
  std::function<void(const DriveView&, std::vector<std::vector<double>>&)> values;  // [function][step]
  std::vector<GenericWave> waves;
  int of_wheel = 0;        // the channel of the wheel that is asked alone; 0: all channels are asked
  bool is_memory = false;  // of what was done before
  bool of_turns = false;   // asked of the turn by itself too; not of what a turn's beginning and end are told by, where
                           // whole counts leave their trace
};

// How finely speeds and yaw rates tell regimes apart. Counts and uneven wheels shake them as they shake the way itself,
// because a wheel that is held up turns the slower: where hats are no wider than that, noise looks like a response to
// its own trace. So far apart they stand at least: what one count is over a short time, and what unevenness of a
// percent makes at walking pace. Of what a driver steers with on a straight the same is true: what shakes the wheels is
// what it answers to.
struct Shaken {
  double speed_mps = 0.0, straight_radps = 0.0, base_m = 0.0;
};
Shaken shaken_by_wheels(const std::vector<DriveView>& views);

// Of a step: the yaw rate beyond that of a straight, and the speed of one wheel.
using OfStep = std::function<double(const EffectStep&)>;
OfStep bend_radps(const Shaken& shaken);
OfStep own_speed_mps(const Shaken& shaken, int wheel_alone);
// A variable where the vehicle goes, in order, of every seventh step.
std::vector<double> seen_on_the_way(const std::vector<DriveView>& views, const OfStep& variable);

// A new one is a function and a line here. Those of which the recordings have too little are left out.
std::vector<Group> groups_of(const std::vector<DriveView>& views, const Shaken& shaken);

}  // namespace odolab
