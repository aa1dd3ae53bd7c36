// Where the truth and the wheels part for a while and go on together from there: a vehicle that is lifted, carried or
// dragged, a tracker that takes something else for it.
#pragma once

#include <vector>

#include "core/calibration/left_out.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/ready_recordings.h"

namespace odolab {

// In each recording, those that are fitted first, on the wheels' clock: where the truth contradicts the calibration
// again as soon as the filter has started anew. Empty where there is none, or where it contradicts it at so many
// places, or for so long, that it is no incident.
std::vector<TimeStretches> parted_stretches(const ReadyRecordings& ready, const Vehicle& nominal);

// Says of each that it is in no list, before all other findings; of those held out in a warning.
void add_parted(Diagnosis& d, const std::vector<TimeStretches>& parted, const ReadyRecordings& ready);

}  // namespace odolab
