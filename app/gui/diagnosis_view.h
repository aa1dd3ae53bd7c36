// What the floor of Diagnose shows.
#pragma once

#include "ui/diagnosis.h"
#include "ui/floor/scene.h"

namespace odolab {

ui::FloorScene diagnosis_scene(const ui::DiagnosisView& view, const ui::DiagnosisState& state, const ui::Theme& theme);

}  // namespace odolab
