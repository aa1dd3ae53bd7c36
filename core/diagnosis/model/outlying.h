// Truth samples that err by themselves.
#pragma once

#include <cstddef>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Truth samples [first, end) that contradict the model one after the other.
struct Refused {
  std::size_t first = 0, end = 0;
  bool comes_back = false;  // what is behind lies where the wheels went on from what was before
  double least_squared = 0.0, squared_behind = 0.0;  // squared innovations: the least of these; of the sample behind
};
// All of a run, whose filter starts anew behind so many.
std::vector<Refused> refused_in_a_row(const InnovationRun& run, const InnovationModel& model, int contradiction);

// Of each truth sample of a run: 1 where it contradicts the model and those about it do not. More than a few in a row
// are no outliers: something happened there that is to be explained; but for a tracker that loses itself for a while,
// so that what is behind lies where the wheels went on from what was before.
std::vector<char> outlying(const InnovationRun& run, const InnovationModel& model);

}  // namespace odolab
