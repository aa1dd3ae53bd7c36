// What a diagnosis leaves to predict with: the calibrated vehicle, and the effects that were found on it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/diagnosis/active_effect.h"
#include "core/diagnosis/diagnosis.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct FittedEffect {
  ActiveEffect active;
  std::vector<std::pair<std::string, double>> stderr_values;  // of the parameters that were estimated
  std::string recording;  // an event (a push, a payload put on) happened in this one alone; empty: acts in all
};

struct FittedModel {
  Vehicle vehicle;  // calibrated, its truth mounting and clock too
  std::vector<FittedEffect> effects;
  // The offset of the truth's clock in the recordings that were fitted on, where each has its own; in others the
  // vehicle's.
  std::vector<std::pair<std::string, double>> truth_clock_s;

  Vehicle vehicle_in(const std::string& recording) const;

  // What acts in a recording of this name.
  std::vector<ActiveEffect> effects_in(const std::string& recording) const;
};

// Faults of the data and effects without a name have no form that could predict; they are left out.
FittedModel model_of(const Diagnosis& diagnosis);
// The calibration alone, as it is without the findings.
FittedModel calibrated_model_of(const Diagnosis& diagnosis);

// Whether a model was fitted on this vehicle: an error where the kind or the encoders differ, which no fit changes.
Result<Done> fits(const FittedModel& model, const Vehicle& nominal);

}  // namespace odolab
