// The guide on the left: which page of how many, and the way out.
#pragma once

#include "ui/actions.h"
#include "ui/guide.h"
#include "ui/look/theme.h"

namespace odolab::ui {

Actions guide_panel(const GuideView& view, const Theme& theme);

}  // namespace odolab::ui
