// The two numbers that every length of a vehicle has: what its odometry believes, and what the machine is.
#pragma once

#include "ui/look/widgets.h"

namespace odolab::ui {

// In a table of three columns that was just begun: their names, and their widths: the first this wide beside 1 of the
// others, or as wide as its widest label.
void nominal_and_true_columns(float label_weight, float widest_label, const Theme& theme);

}  // namespace odolab::ui
