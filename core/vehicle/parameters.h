// The parameters of a vehicle of any kind as one list, for those who show or edit them.
#pragma once

#include <string>
#include <vector>

#include "core/vehicle/vehicle.h"

namespace odolab {

enum class ParameterUnit {
  metres,
  radians,
  radians_per_metre,
  ratio,
  share,  // shown in percent
  count,
  kilograms,
  kilogram_square_metres,
  hertz
};

struct VehicleParameter {
  std::string group;  // "truck A", "castor 2"; empty: the vehicle itself
  std::string label;  // "radius left"
  std::string about;  // what it is, in a sentence
  ParameterUnit unit = ParameterUnit::metres;
  double* value = nullptr;          // of the vehicle that was asked
  bool machine_has_its_own = true;  // false: of the odometry alone, like an encoder's counts
};

// In the order of the vehicle file; the values may be changed through them. A kind's list is in parameters.cpp.
std::vector<VehicleParameter> parameters_of(VehicleKind& kind);

// "CLAPPER", "synchro drive": the kind in the field's words.
std::string words_of(const VehicleKind& kind);

}  // namespace odolab
