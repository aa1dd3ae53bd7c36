// Truth samples that err by themselves.
#pragma once

#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Of each truth sample of a run: 1 where it contradicts the model and those about it do not. More than a few in a row
// are no outliers: something happened there that is to be explained; but for a tracker that loses itself for a while,
// so that what is behind lies where the wheels went on from what was before.
std::vector<char> outlying(const InnovationRun& run, const InnovationModel& model);

}  // namespace odolab
