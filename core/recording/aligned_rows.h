// Several channels brought to common times.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

struct AlignedRows {
  std::vector<double> time_s;
  std::vector<std::vector<double>> values;  // [row][channel]
};

// The named channels at every time at which any of them was read and all can be told: a channel that was sampled at
// other times is interpolated between its neighbours, an angle the shorter way round and without jumps at a turn. No
// rows where one of the channels is not there.
struct AlignedChannel {
  std::string name;
  bool is_angle = false;  // an absolute one, which may wrap
};
AlignedRows aligned_rows(const Recording& recording, const std::vector<AlignedChannel>& channels);

// The names of those channels that the recording lacks, with commas between; empty where none is missing.
std::string missing_of(const Recording& recording, const std::vector<AlignedChannel>& channels);

}  // namespace odolab
