// A fitted model of a linked or castor vehicle as models of its units, with recordings to drive them by.
#pragma once

#include <vector>

#include "core/calibration/innovations.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/recording/recording.h"

namespace odolab {

// The effects that act on this unit, in its own words; biased joints act on none, since they are in the vehicle.
std::vector<ActiveEffect> effects_of_unit(const std::vector<ActiveEffect>& effects, const VehicleUnit& unit,
                                          const std::vector<VehicleUnit>& all);

FittedModel model_of_unit(const FittedModel& model, std::size_t unit);

// Each recording as that unit saw it, where the model's vehicle is right about the joints. Recordings without a truth
// that has headings are left out.
std::vector<Recording> recordings_of_unit(const std::vector<Recording>& recordings, const FittedModel& model,
                                          std::size_t unit);

// A unit's wheels by themselves, as effects look at them; of the truth there is no more than a beginning.
InnovationRun run_of_wheels(const std::vector<UnitSample>& samples, std::size_t unit);

// What the units really did, as far as the effects are known: wheels as if they had rolled truly, and how far each unit
// moved to its left in the interval that ends at each sample.
struct TrueUnits {
  std::vector<UnitSample> samples;
  std::vector<std::vector<double>> sideways_m;  // [sample][unit]
};
TrueUnits without_effects(const std::vector<UnitSample>& samples, const std::vector<VehicleUnit>& units,
                          const std::vector<std::vector<BodyMotion>>& motions);

}  // namespace odolab
