#include "core/calibration/internal.h"

#include "core/calibration/castors.h"
#include "core/calibration/linked.h"
#include "core/calibration/trailer.h"

namespace odolab {

bool can_calibrate_internally(const Vehicle& vehicle) {
  return std::holds_alternative<Clapper>(vehicle.kind) || std::holds_alternative<OmniMate>(vehicle.kind) ||
         std::holds_alternative<MultiCastor>(vehicle.kind) || std::holds_alternative<SmartEncoderTrailer>(vehicle.kind);
}

Result<InternalCalibration> calibrate_internally(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                 const Progress& progress) {
  if (std::holds_alternative<MultiCastor>(nominal.kind)) return calibrate_castors(recordings, nominal);
  if (std::holds_alternative<SmartEncoderTrailer>(nominal.kind))
    return calibrate_trailer(recordings, nominal, progress);
  return calibrate_linked(recordings, nominal, progress);
}

}  // namespace odolab
