// The drawings of what a guide asks to be driven.
#pragma once

#include "core/guide/guide_session.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// In the remaining width, this high.
void guide_drawing(const GuideSession& session, float height, const Theme& theme);

}  // namespace odolab::ui
