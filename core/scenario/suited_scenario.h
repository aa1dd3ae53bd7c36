// The same experiment with another vehicle.
#pragma once

#include "core/scenario/scenario.h"

namespace odolab {

// The scenario with this vehicle in it, just as its drawing says. Where the vehicle is of another kind than before,
// what does not go with it is replaced: weights, motors and encoder period by those that the reports and our scenarios
// give that kind, a path or effects that it cannot have by none (a square). The result has no problems that the
// scenario and the vehicle did not have.
Scenario with_vehicle(Scenario scenario, const Vehicle& vehicle);

// The motors of a vehicle of this kind where nobody says more: those of a Motor, but of tracks strong enough to skid
// them (100 N m: a sprocket of 0.1 m under half of 200 kg needs 78 N m at a friction of 0.8; an assumption).
Motor usual_motor(const VehicleKind& kind);

}  // namespace odolab
