// A fitted model in the planar world: recordings driven with and without what was found, as a proof from other physics.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/recording/recording.h"
#include "physics/replay.h"

namespace odolab {

struct ModelReplay {
  // `calibrated`: before; `with_findings`: after. None where no recording has a
  // truth with headings to compare with.
  FitTable fit;
  std::vector<std::string> not_switched_on;  // effects that the planar world does not have, a sentence each
};

// By a recording's name, when its encoders did not tell the way.
using WaysUnknown = std::map<std::string, std::vector<std::pair<double, double>>>;

// The error of a replay that is gathered across none of these; none where its truth has no headings.
std::optional<TrackError> error_where_known(const Replay& replay, const WaysUnknown& unknown,
                                            const std::string& recording);

// Drives the planar vehicle by each recording's own wheels or commands. The normalised chi2 of a replay is its squared
// error, mean over the two coordinates and the heading, over that which `noise_floor` leaves; not a number without one.
// `file`: the vehicle that the models were fitted on, by which a base without encoders obeys its commands. No error is
// gathered across `unknown`.
Result<ModelReplay> replay_model(const std::vector<Recording>& recordings, const Vehicle& file,
                                 const FittedModel& before, const FittedModel& after,
                                 const std::optional<FitFigures>& noise_floor, const Progress& progress = {},
                                 const WaysUnknown& unknown = {});

// One recording driven by its own inputs with what of the model acts in it; of a linked vehicle the whole of it.
Result<Replay> replay_with(const FittedModel& model, const Vehicle& file,
                           const std::shared_ptr<const Recording>& recording, const Progress& progress = {});

// The effect as a scenario switches it on for that recording (as_in_a_scenario): loads and drifts by its clock. None
// where the planar world does not have it.
std::optional<ActiveEffect> effect_for_scenario(const ActiveEffect& fitted, const Recording& recording);

// Errors of several recordings as one: the mean over all their windows. None where none was judged.
std::optional<FitFigures> joined_figures(const std::vector<std::optional<TrackError>>& errors,
                                         const std::optional<FitFigures>& noise_floor = std::nullopt);

}  // namespace odolab
