// What is entered on each kind of page.
#pragma once

#include "ui/actions.h"
#include "ui/guide.h"
#include "ui/look/theme.h"
#include "ui/panels/guide_page.h"

namespace odolab::ui {

Actions guide_entries(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme);

}  // namespace odolab::ui
