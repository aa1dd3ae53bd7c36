#include "core/calibration/internal.h"

#include "core/calibration/castors.h"
#include "core/calibration/linked.h"

namespace odolab {

bool can_calibrate_internally(const Vehicle& vehicle) {
  return std::holds_alternative<Clapper>(vehicle.kind) || std::holds_alternative<OmniMate>(vehicle.kind) ||
         std::holds_alternative<MultiCastor>(vehicle.kind);
}

Result<InternalCalibration> calibrate_internally(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                 const Progress& progress) {
  if (std::holds_alternative<MultiCastor>(nominal.kind)) return calibrate_castors(recordings, nominal);
  return calibrate_linked(recordings, nominal, progress);
}

}  // namespace odolab
