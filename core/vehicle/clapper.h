// The CLAPPER: two differential-drive trucks on a compliant linkage (J. Borenstein, "Internal Correction of
// Dead-reckoning Errors With the Compliant Linkage Vehicle", 1995).
#pragma once

#include "core/vehicle/linked_trucks.h"

namespace odolab {

struct Clapper : LinkedTrucks {
  static constexpr const char* kKind = "clapper";
};

}  // namespace odolab
