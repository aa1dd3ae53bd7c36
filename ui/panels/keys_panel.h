// F1: the keys.
#pragma once

#include "ui/look/theme.h"

namespace odolab::ui {

void keys_panel(bool& open, const Theme& theme);

}  // namespace odolab::ui
