// What of the session each panel is shown, as the plain structs that the panels ask for.
#pragma once

#include <string>
#include <vector>

#include "app/gui/session.h"
#include "ui/bench.h"
#include "ui/compare.h"
#include "ui/floor/scene.h"
#include "ui/panels/error_panel.h"
#include "ui/panels/readout_panel.h"
#include "ui/panels/transport_bar.h"

namespace odolab {

// `shown` is the state of the run at the shown moment.
ui::FloorScene drive_scene(const Session& session, const SimulationState& shown, const ui::Theme& theme);
ui::FloorScene compare_scene(const Session& session, const ui::Theme& theme);
ui::Transport drive_transport(const Session& session, const ui::Theme& theme);
ui::Transport compare_transport(const Session& session, const ui::Theme& theme);
ui::Bench bench_of(const Session& session);
ui::Compare compare_of(const Session& session, const std::vector<std::string>& example_files);
ui::Readout readout_of(const Session& session, const SimulationState& shown);
ui::ErrorNow error_now(const Session& session);

}  // namespace odolab
