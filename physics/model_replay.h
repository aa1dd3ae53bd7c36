// A fitted model in the planar world: recordings driven with and without what was found, as a proof from other physics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/recording/recording.h"

namespace odolab {

struct ModelReplay {
  // `calibrated`: before; `with_findings`: after. None where no recording has a
  // truth with headings to compare with.
  FitTable fit;
  std::vector<std::string> not_switched_on;  // effects that the planar world does not have, a sentence each
};

// Drives the planar vehicle by each recording's own wheels or commands. The normalised chi2 of a replay is its squared
// error, mean over the two coordinates and the heading, over that which `noise_floor` leaves; not a number without one.
Result<ModelReplay> replay_model(const std::vector<Recording>& recordings, const FittedModel& before,
                                 const FittedModel& after, const std::optional<FitFigures>& noise_floor,
                                 const Progress& progress = {});

}  // namespace odolab
