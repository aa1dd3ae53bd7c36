// Diagnose, on the left: the vehicle, the runs, the mystery, and the button that asks.
#pragma once

#include "ui/actions.h"
#include "ui/diagnosis.h"

namespace odolab::ui {

// `ask_for_file` is set where a person wants to open one; `drive_vehicle`: the name of the vehicle that Drive has.
Actions diagnosis_runs_panel(const DiagnosisView& view, DiagnosisState& state, const std::string& drive_vehicle,
                             bool& ask_for_file, const Theme& theme);

// In the middle while there are no runs: what this is for, and how to begin.
Actions diagnosis_welcome(const DiagnosisView& view, DiagnosisState& state, bool& ask_for_file, const Theme& theme);

}  // namespace odolab::ui
