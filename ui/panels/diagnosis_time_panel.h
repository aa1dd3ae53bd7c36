// Diagnose, at the bottom: the mismatch over time, brushed together with the floor, and what it depends on.
#pragma once

#include "ui/actions.h"
#include "ui/diagnosis.h"

namespace odolab::ui {

Actions diagnosis_time_panel(const DiagnosisView& view, DiagnosisState& state, const Theme& theme);

}  // namespace odolab::ui
