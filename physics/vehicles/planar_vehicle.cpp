#include "physics/vehicles/planar_vehicle.h"

#include <cassert>

namespace odolab {

// Every kind: its file defines the function that makes it, null where the scenario's vehicle is of another kind.
#define ODOLAB_EACH_VEHICLE(X) \
  X(differential_drive)        \
  X(clapper)                   \
  X(omnimate)                  \
  X(smart_encoder_trailer)     \
  X(multi_castor)              \
  X(synchro_drive)             \
  X(tracked)                   \
  X(encoder_trailer)

#define ODOLAB_DECLARE_VEHICLE(kind) std::unique_ptr<PlanarVehicle> make_##kind(const VehicleSetup&);
ODOLAB_EACH_VEHICLE(ODOLAB_DECLARE_VEHICLE)

std::unique_ptr<PlanarVehicle> make_planar_vehicle(const VehicleSetup& setup) {
  std::unique_ptr<PlanarVehicle> vehicle;
#define ODOLAB_TRY(kind) \
  if (!vehicle) vehicle = make_##kind(setup);
  ODOLAB_EACH_VEHICLE(ODOLAB_TRY)
  assert(vehicle);
  return vehicle;
}

}  // namespace odolab
