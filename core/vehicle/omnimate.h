// The OmniMate: two powered split castors under a platform, with free castors; its odometry is the CLAPPER's (J.
// Borenstein 1998, as cited in the multi-castor paper).
#pragma once

#include "core/vehicle/linked_trucks.h"

namespace odolab {

struct OmniMate : LinkedTrucks {
  static constexpr const char* kKind = "omnimate";
};

}  // namespace odolab
