// How the truth's clock lies against the wheels' by what both say from moment to moment: README.md, "Clocks".
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Truth at t belongs to wheels at t - (offset_s - rate (t - t_0)), t_0 the time of the first truth sample.
struct AlignedClock {
  double offset_s = 0.0;
  double rate = 0.0;
  double gain = 0.0;  // of chi-square beside the clock as it was; samples taken as independent
};

// The best of all offsets within half a second of the model's and all rates that stay there, or within two where it
// lies at the end: a robot's jitter fits the truth's only where the clocks agree, so the likelihood has many summits
// and a descent finds the nearest. None where the truth is too sparse to tell or gives no headings.
std::optional<AlignedClock> aligned_clock(const InnovationRun& run, const InnovationModel& model);

// Those of all runs, each by the model of that run.
std::vector<std::optional<AlignedClock>> aligned_clocks(const std::vector<InnovationRun>& runs,
                                                        const std::function<InnovationModel(int run)>& model_of);

// Whether one of them gains so much that a fit from there is worth a try.
bool worth_a_try(const std::vector<std::optional<AlignedClock>>& clocks);

// Those of all runs, or as the model has it where a run does not tell; none where none is worth a try.
std::optional<std::vector<AlignedClock>> moved_clocks(const std::vector<InnovationRun>& runs,
                                                      const std::function<InnovationModel(int run)>& model_of);

}  // namespace odolab
