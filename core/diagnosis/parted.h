// Where the truth and the wheels part for a while and go on together from there: a vehicle that is lifted, carried or
// dragged, a tracker that takes something else for it; and where something goes on for a while.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/left_out.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/ready_recordings.h"

namespace odolab {

// What happened there and nowhere else, and is left out of all else.
struct Incidents {
  std::vector<TimeStretches> of_each;  // recording, those that are fitted first, on the wheels' clock
  std::string what;                    // the truth and the wheels do there, in words
  double gain = 0.0, p_value = 0.0;    // as of what has no name
  bool empty() const { return of_each.empty(); }
};

// Where the truth contradicts the calibration again as soon as the filter has started anew. None where there is none,
// or where it contradicts it at so many places, or for so long, that it is no incident.
Incidents parted_stretches(const ReadyRecordings& ready, const Vehicle& nominal);

// What has no name, where it goes on for a while and nowhere else; else none. `recordings`: all, those held out too.
Incidents incidents_of(const Unnamed& unnamed, std::size_t recordings);

// Says of each that it is in no list, before all other findings; of those held out in a warning.
void add_parted(Diagnosis& d, const Incidents& incidents, const ReadyRecordings& ready);

}  // namespace odolab
