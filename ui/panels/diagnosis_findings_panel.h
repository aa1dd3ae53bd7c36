// Diagnose, on the right: the answer.
#pragma once

#include "ui/actions.h"
#include "ui/diagnosis.h"

namespace odolab::ui {

Actions diagnosis_findings_panel(const DiagnosisView& view, DiagnosisState& state, const Theme& theme);

// The stretches of the shown run in which that finding was located.
std::vector<Stretch> stretches_of(const DiagnosedRun& run, std::size_t finding);

}  // namespace odolab::ui
