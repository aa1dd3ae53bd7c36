// What went wrong, in words, until a person has read it; the app stays open.
#pragma once

#include <string>
#include <vector>

#include "ui/actions.h"
#include "ui/look/theme.h"

namespace odolab::ui {

struct Message {
  std::string text;
  bool is_error = true;
  double left_s = 1e300;  // until it goes by itself
};

// Height that the bar needs at this width: one line of text or two; 0 without messages.
float message_bar_height(const std::vector<Message>& messages, float width, const Theme& theme);
// Fills its window with the newest message, a click on which dismisses it, and says how many older ones wait behind.
Actions message_bar(const std::vector<Message>& messages, const Theme& theme);

}  // namespace odolab::ui
