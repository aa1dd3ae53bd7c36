// How far the replay is from the recording: now, per metre, at the end; nominal beside calibrated.
#pragma once

#include <optional>

#include "ui/compare.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// The last sample of the truth at the moment shown, the simulated pose and the dead reckoning. The gap is the error
// gathered since the first sample, as in TrackError.
struct ErrorNow {
  std::optional<Pose> truth, simulated, dead_reckoned;
  double simulated_gap_m = 0.0, simulated_gap_heading_rad = 0.0;
};

void error_panel(const Compare& compare, const ErrorNow& now, const Theme& theme);

}  // namespace odolab::ui
