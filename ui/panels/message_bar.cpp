#include "ui/panels/message_bar.h"

#include <algorithm>
#include <cmath>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

std::string words_of_more(const std::vector<Message>& messages) {
  return messages.size() > 1 ? "+" + std::to_string(messages.size() - 1) + " more" : "";
}

float width_of_more(const std::vector<Message>& messages, const Theme& theme) {
  const std::string more = words_of_more(messages);
  return more.empty() ? 0.0f : ImGui::CalcTextSize(more.c_str()).x + theme.px(22);
}

float text_width(const std::vector<Message>& messages, float width, const Theme& theme) {
  return std::max(theme.px(60),
                  width - theme.px(34) - ImGui::GetFrameHeight() * 1.15f - width_of_more(messages, theme));
}

float height_of(const std::string& text, float width) {
  return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y;
}

// Shortened to what two lines of this width hold; the whole of it is in the tooltip.
std::string two_lines_of(const std::string& text, float width) {
  const float most = 2.5f * ImGui::GetTextLineHeight();
  if (height_of(text, width) < most) return text;
  std::string shorter = text;
  while (!shorter.empty() && height_of(shorter + "…", width) > most) {
    while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0u) == 0x80u) shorter.pop_back();
    if (!shorter.empty()) shorter.pop_back();
  }
  return shorter + "…";
}

}  // namespace

float message_bar_height(const std::vector<Message>& messages, float width, const Theme& theme) {
  if (messages.empty()) return 0.0f;
  const float inner = text_width(messages, width, theme);
  return std::max(height_of(two_lines_of(messages.back().text, inner), inner) + theme.px(12),
                  ImGui::GetFrameHeight() + theme.px(6));
}

Actions message_bar(const std::vector<Message>& messages, const Theme& theme) {
  Actions actions;
  if (messages.empty()) return actions;
  const Message& m = messages.back();
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const float inner = text_width(messages, size.x, theme), more_width = width_of_more(messages, theme);
  const std::string text = two_lines_of(m.text, inner);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 front = m.is_error ? theme.error : theme.ink;
  draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, m.is_error ? theme.error_paper : theme.note_paper);
  draw.AddRectFilled(at, {at.x + theme.px(4), at.y + size.y}, front);
  draw.AddLine({at.x, at.y + size.y - 1}, {at.x + size.x, at.y + size.y - 1}, theme.line);

  const float side = ImGui::GetFrameHeight(), cross_width = 1.15f * side;
  const float y = std::round(at.y + 0.5f * (size.y - side));
  const std::size_t newest = messages.size() - 1;
  ImGui::SetCursorScreenPos(at);
  if (ImGui::InvisibleButton("##newest", {size.x - cross_width - more_width - theme.px(10), size.y}))
    actions.push_back(DismissMessage{newest});
  if (text != m.text) tooltip(m.text, theme);
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(),
               {at.x + theme.px(16), std::round(at.y + 0.5f * (size.y - height_of(text, inner)))}, front, text.c_str(),
               nullptr, inner);
  if (more_width > 0.0f) {
    ImGui::SetCursorScreenPos({at.x + size.x - cross_width - more_width - theme.px(8), y});
    ButtonLook all;
    all.tip = "Dismiss all";
    if (text_button(words_of_more(messages).c_str(), theme, all, more_width - theme.px(4)))
      for (std::size_t i = messages.size(); i-- > 0;) actions.push_back(DismissMessage{i});
  }
  ImGui::SetCursorScreenPos({at.x + size.x - cross_width - theme.px(6), y});
  ButtonLook look;
  look.tip = "Dismiss";
  if (icon_button("dismiss", Icon::close, theme, look)) actions.push_back(DismissMessage{newest});
  return actions;
}

}  // namespace odolab::ui
