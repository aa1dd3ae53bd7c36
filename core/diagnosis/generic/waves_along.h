// Waves along one axis: in time, along the way, with the turning and with the turns of a wheel.
#pragma once

#include <vector>

#include "core/diagnosis/generic/wave.h"

namespace odolab {

// Those with one axis: a cell is so short that no wave turns far within it.
struct WaveAxis {
  Along along;
  const char *name, *unit;
  double cell, shortest, longest;  // of a wave; beyond the longest it is another group's
};
constexpr WaveAxis kAxes[] = {{Along::time, "time", "s", 0.1, 0.35, 1e300},
                              {Along::way, "way", "m", 0.02, 0.12, 20.0},
                              {Along::turning, "turning", "rad", 0.05, 0.25, 2.0 * kPi / 2.4},
                              // Gears before a wheel turn faster than it, belts and tracks slower.
                              {Along::left_wheel, "its angle", "turns", 0.02, 0.125, 6.0},
                              {Along::right_wheel, "its angle", "turns", 0.02, 0.125, 6.0}};

// All waves of an axis, by the scores of the motions in each step.
std::vector<Heard> heard_along(const WaveAxis& axis, const std::vector<DriveView>& views,
                               const std::vector<std::vector<BodyMotion>>& scores);

// The strongest wave between the neighbours of one: beside its true length it would come and go against what there is.
Wave between_neighbours(Wave wave, int channel, const std::vector<DriveView>& views,
                        const std::vector<std::vector<BodyMotion>>& scores);

}  // namespace odolab
