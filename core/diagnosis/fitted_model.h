// What a diagnosis leaves to predict with: the calibrated vehicle, and the effects that were found on it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/diagnosis/active_effect.h"
#include "core/diagnosis/diagnosis.h"
#include "core/recording/recording.h"
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
  // The fingerprint of each recording that was fitted on (core/recording/same_samples.h), where known.
  std::vector<std::pair<std::string, std::string>> fingerprints;

  // The name under which it was fitted on, none where it was not: by its samples, and by its own name only where the
  // model knows no fingerprint. Files are renamed, and files of other folders have the same names.
  std::optional<std::string> fitted_as(const Recording& recording) const;

  Vehicle vehicle_in(const std::string& recording) const;

  // What acts in a recording of this name.
  std::vector<ActiveEffect> effects_in(const std::string& recording) const;
};

// Faults of the data and effects without a name have no form that could predict; they are left out.
FittedModel model_of(const Diagnosis& diagnosis);
// And what tells the recordings that were fitted on from all others; held-out ones among those given are none of them.
FittedModel model_of(const Diagnosis& diagnosis, const std::vector<Recording>& given);
// The calibration alone, as it is without the findings.
FittedModel calibrated_model_of(const Diagnosis& diagnosis);

// Whether a model was fitted on this vehicle: an error where the kind or the encoders differ, which no fit changes.
Result<Done> fits(const FittedModel& model, const Vehicle& nominal);

}  // namespace odolab
