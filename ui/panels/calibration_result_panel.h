// What the squares say: the measure, the two types of errors, the corrected vehicle, each with its uncertainty.
#pragma once

#include "ui/bench.h"
#include "ui/look/theme.h"

namespace odolab::ui {

void calibration_result_panel(const Bench& bench, const Theme& theme);

}  // namespace odolab::ui
