// Waves of the floor, under the vehicle and under each of its wheels.
#pragma once

#include <vector>

#include "core/diagnosis/generic/wave.h"

namespace odolab {

// All waves of the floor, by the scores of the motions in each step. All recordings share phase and amplitude.
std::vector<Heard> heard_on_floor(const std::vector<DriveView>& views,
                                  const std::vector<std::vector<BodyMotion>>& scores);

}  // namespace odolab
