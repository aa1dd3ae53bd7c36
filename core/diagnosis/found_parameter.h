// A number that was fitted, by the name that the catalogue gives it.
#pragma once

#include <string>

namespace odolab {

struct FoundParameter {
  std::string name;
  double value = 0.0;
  double stderr_value = 0.0;
  std::string unit;
};

}  // namespace odolab
