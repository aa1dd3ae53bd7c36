// What was sampled in a run, and its form as a recording.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/track.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "physics/driver/base_command.h"

namespace odolab {

struct SampledRun {
  std::vector<std::string> channels;  // that the vehicle's sensors fill
  std::vector<double> time_s;         // of each of their samples
  std::vector<double> readings;       // a row of all channels for each sample
  std::vector<BaseCommand> commands;  // one with each of the samples, or none
  Track truth;                        // on its own clock
};

// The robot and the truth have rates of their own; where both were read at one time they share a row. The columns are
// those that the sensors record.
Recording recording_of(const SampledRun& run, const Sensors& sensors, const std::string& name);

}  // namespace odolab
