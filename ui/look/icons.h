// Small pictures on buttons, drawn as shapes so that they need no font and stay sharp at every scale.
#pragma once

#include <imgui.h>

namespace odolab::ui {

enum class Icon {
  play,
  pause,
  step_forward,
  step_back,
  to_start,
  to_end,
  restart,
  pointer,
  cable,
  disc,
  rectangle,
  fit,
  follow,
  lens,
  exaggerate,
  layers,
  close,
  brush,
};

// Drawn inside a square of side `size` about `centre`.
void draw_icon(ImDrawList& draw, Icon icon, ImVec2 centre, float size, ImU32 colour);

}  // namespace odolab::ui
