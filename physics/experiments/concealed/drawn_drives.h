// What a robot drives: the runs that diagnosis is given, and runs of other kinds that are kept back.
#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/scenario/scenario.h"

namespace odolab::concealed {

struct DrawnDrive {
  std::string name;
  Path path;
  Driving driving;
  Pose start;
};

struct DrawnDrives {
  std::vector<DrawnDrive> given;     // four to six runs of 40 to 80 s; on poor sets squares alone
  std::vector<DrawnDrive> held_out;  // two of kinds that `given` does not have
};

// `poor`: UMBmark's squares in both directions and nothing else are given.
DrawnDrives drawn_drives(Random& random, bool poor);

}  // namespace odolab::concealed
