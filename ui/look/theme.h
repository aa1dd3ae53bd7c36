// Colours, fonts and spacing of the window: one light and one dark set, the same meaning of a colour everywhere.
#pragma once

#include <imgui.h>

namespace odolab::ui {

// 0xrrggbb, opaque.
constexpr ImU32 rgb(unsigned hex) { return IM_COL32((hex >> 16) & 255u, (hex >> 8) & 255u, hex & 255u, 255); }

struct Theme {
  bool dark = false;
  float scale = 1.0f;  // pixels for each pixel of a 96 dpi screen

  // Null where no font file was found; then ImGui's own is used.
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* large = nullptr;

  // Surfaces and writing.
  ImU32 paper = 0;   // the floor, the plots
  ImU32 panel = 0;   // behind the parameters
  ImU32 raised = 0;  // fields and buttons
  ImU32 hovered = 0;
  ImU32 pressed = 0;
  ImU32 line = 0;    // borders, major grid
  ImU32 faint = 0;   // minor grid
  ImU32 ink = 0;     // words, and the truth
  ImU32 muted = 0;   // units, explanations
  ImU32 on_ink = 0;  // words on a surface of ink
  ImU32 error = 0;
  ImU32 error_paper = 0;
  ImU32 note_paper = 0;

  // Data: the set of Okabe and Ito, safe for colour-blind eyes.
  ImU32 truth = 0;
  ImU32 orange = 0;  // the estimate under study
  ImU32 blue = 0;    // dead reckoning of a recording; the counter-clockwise runs
  ImU32 green = 0;
  ImU32 purple = 0;
  ImU32 sky = 0;
  ImU32 bump = 0;
  ImU32 bump_edge = 0;
  ImU32 zone = 0;

  float px(float at_scale_1) const { return at_scale_1 * scale; }
};

Theme make_theme(bool dark, float scale);

// Makes ImGui's own widgets look like the theme, and a click on a number begin to type it.
void apply(const Theme& theme);

// The same colour, `alpha` times as opaque.
ImU32 faded(ImU32 colour, float alpha);

// Writes in a font of the theme until the end of the scope; a null font changes nothing.
class WithFont {
 public:
  explicit WithFont(ImFont* font);
  ~WithFont();
  WithFont(const WithFont&) = delete;
  WithFont& operator=(const WithFont&) = delete;

 private:
  bool pushed_;
};

}  // namespace odolab::ui
