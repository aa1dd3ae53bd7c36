// What of the session each panel is shown, as the plain structs that the panels ask for.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "app/gui/session.h"
#include "ui/bench.h"
#include "ui/compare.h"
#include "ui/floor/scene.h"
#include "ui/panels/error_panel.h"
#include "ui/panels/estimator_panel.h"
#include "ui/panels/readout_panel.h"
#include "ui/panels/transport_bar.h"

namespace odolab {

// `shown` is the state of the run at the shown moment.
// The named estimators are shown beside the one that the vehicle steers by.
ui::FloorScene drive_scene(const Session& session, const SimulationState& shown, const ui::Theme& theme,
                           const std::set<std::string>& estimators = {});
ui::FloorScene compare_scene(const Session& session, const ui::Theme& theme);
ui::Transport drive_transport(const Session& session, const ui::Theme& theme,
                              const std::set<std::string>& estimators = {});
ui::Transport compare_transport(const Session& session, const ui::Theme& theme);
ui::Bench bench_of(const Session& session);
ui::Compare compare_of(const Session& session, const std::vector<std::string>& example_files);
ui::Estimators estimators_of(const Session& session, const SimulationState& shown, const ui::Theme& theme);
ui::Readout readout_of(const Session& session, const SimulationState& shown, const ui::Theme& theme);
ui::ErrorNow error_now(const Session& session);

}  // namespace odolab
