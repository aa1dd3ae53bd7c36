// What stands in the place of an outside truth where there is none: the way of a vehicle by all its units but one.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// A recording as it is understood so far: without the effects of units that were blamed.
struct Understood {
  const Recording* recording = nullptr;
  std::vector<UnitSample> samples;
};

// What is known of the vehicle so far; its truth sits at the reference point.
struct Known {
  Vehicle vehicle;
  std::vector<DifferentialDrive> drives;
};

// Whether a finding is neither of one place nor of one moment: places are known on the truth's floor alone, and moments
// are over.
bool lasts(const Finding& finding);

Vehicle without_mounting(Vehicle vehicle);

// The way of the vehicle's reference point by all units but one; of a platform by all where `without` is none of them.
Result<Track> way_by_others(const Known& known, const std::vector<UnitSample>& samples, std::size_t without);

}  // namespace odolab
