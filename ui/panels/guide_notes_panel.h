// The guide on the right: the runs of the page, one by one, and what they say so far.
#pragma once

#include "ui/actions.h"
#include "ui/guide.h"
#include "ui/look/theme.h"

namespace odolab::ui {

Actions guide_notes_panel(const GuideView& view, const Theme& theme);

}  // namespace odolab::ui
