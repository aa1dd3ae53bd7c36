// The few widgets that the panels are made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/look/units.h"

namespace odolab::ui {

// Shown while the item before it is hovered, enabled or not. Long text is wrapped.
void tooltip(const std::string& text, const Theme& theme);

// What a button is besides its picture or words.
struct ButtonLook {
  bool enabled = true;
  bool toggled = false;
  bool primary = false;      // the one button that a person looks for
  std::string tip;           // what it does, with its key
  std::string why_disabled;  // shown instead while disabled
};
bool icon_button(const char* id, Icon icon, const Theme& theme, const ButtonLook& look);
bool text_button(const char* label, const Theme& theme, const ButtonLook& look, float width = 0.0f);
// How far work in the background is, with a button beside it; true where that was pressed to stop it. A width of 0
// takes the place there is, a button of -1 what is left of the row.
bool job_progress(double share_done, const Theme& theme, float bar_width = 0.0f, float button_width = -1.0f);

// Inside a popup: Escape closes it, and what is open of it.
void close_on_escape();

// One of several; returns the new choice when it changes. Only the first `available` can be chosen.
std::optional<int> segmented(const char* id, const std::vector<std::string>& labels, int chosen, const Theme& theme,
                             float width = 0.0f, int available = 1000);

// A heading that can be folded; true while open.
bool section(const char* title, const Theme& theme, bool open_at_first = true);
// A small heading inside a panel.
void heading(const char* title, const Theme& theme);
// The text with line ends where it is as wide as this; broken at blanks alone, and what has none at slashes or letters.
std::string wrapped_at(const std::string& text, float width);
// Words wrapped at blanks alone, so that no number is broken; `width` 0: the remaining one.
void words(const std::string& text, ImU32 colour, float width = 0.0f);
// The same in the quiet colour.
void note(const std::string& text, const Theme& theme);
// The same in the colour of errors.
void warning(const std::string& text, const Theme& theme);

// What happened to a field in this frame. `done` comes once, when the person lets go or leaves the field with another
// value than before.
enum class Edited { no, changing, done };

// A number that is typed after a click, or dragged; Tab goes on to the next. Bounds are SI and may be equal for none. A
// number typed outside of them is brought to the nearest bound, and a note under the field says so. Escape brings the
// old one back.
struct NumberField {
  const char* id;
  Unit unit;
  double least = 0.0;
  double most = 0.0;
  std::string tip;
  bool enabled = true;
};
Edited number_field(const NumberField& field, double& value_si, float width, const Theme& theme);
// The same behind a label on the left.
Edited number_row(const char* label, const NumberField& field, double& value_si, const Theme& theme);
// A whole number behind a label.
Edited count_row(const char* label, const char* id, int& value, int least, int most, const std::string& tip,
                 const Theme& theme);

// Which of two edits says more.
inline Edited more(Edited a, Edited b) { return a > b ? a : b; }

// Text that ends at the right edge of the remaining width.
void text_right(const std::string& text, ImU32 colour);

// The name of a file as words: "square with cable" of ".../square_with_cable.toml".
std::string words_of_file(const std::string& path);

// Text shortened with an ellipsis to a width.
std::string fitted(const std::string& text, float width);

}  // namespace odolab::ui
