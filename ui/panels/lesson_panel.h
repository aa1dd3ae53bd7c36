// A lesson: its prompt, what to look at, its question, and the way on.
#pragma once

#include "ui/actions.h"
#include "ui/lesson.h"
#include "ui/look/theme.h"

namespace odolab::ui {

struct LessonPanelState {
  int stake = 10;
};

Actions lesson_panel(const LessonView& view, LessonPanelState& state, const Theme& theme);

}  // namespace odolab::ui
