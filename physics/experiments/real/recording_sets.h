// The sets of real recordings that others measured, found in a folder laid out as theirs.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Runs of one robot, or of several that are alike.
struct RecordingSet {
  std::string name;     // "optiodom square"
  std::string folder;   // beside the others
  Vehicle nominal;      // as its makers give it
  bool robots = false;  // each recording is a robot of its own
  std::vector<Recording> recordings;
  std::vector<std::string> notes;  // what the import had to say, and what could not be read
};

// The folder that is looked into: as given, else the environment's ODOLAB_RECORDINGS, else ../shared/recordings.
std::string recordings_folder(const std::string& given);

// OptiOdom: every <folder>/optiodom/KIND/ID with synchronised runs is a set, and one more with its raw pairs. UTIAS:
// every folder mrclam* is a set of robots, their truth thinned to 10 Hz. A kind of which nothing is there leaves a
// sentence in `skipped`.
std::vector<RecordingSet> recording_sets(const std::string& folder, std::vector<std::string>& skipped);

}  // namespace odolab
