#include "ui/panels/message_bar.h"

#include <algorithm>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

constexpr std::size_t kMost = 4;  // the newest; older ones come up as these are dismissed

float text_width(float width, const Theme& theme) {
  return width - theme.px(24) - ImGui::GetFrameHeight() * 1.15f - theme.px(28);
}

float row_height(const Message& message, float width, const Theme& theme) {
  const float text = ImGui::CalcTextSize(message.text.c_str(), nullptr, false, text_width(width, theme)).y;
  return std::max(text + theme.px(12), ImGui::GetFrameHeight() + theme.px(6));
}

}  // namespace

float message_bar_height(const std::vector<Message>& messages, float width, const Theme& theme) {
  float height = 0.0f;
  for (std::size_t i = messages.size() - std::min(kMost, messages.size()); i < messages.size(); ++i)
    height += row_height(messages[i], width, theme);
  return height;
}

Actions message_bar(const std::vector<Message>& messages, const Theme& theme) {
  Actions actions;
  const ImVec2 at = ImGui::GetWindowPos();
  const float width = ImGui::GetWindowSize().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  float y = at.y;
  for (std::size_t i = messages.size() - std::min(kMost, messages.size()); i < messages.size(); ++i) {
    const Message& m = messages[i];
    const float height = row_height(m, width, theme);
    const ImU32 front = m.is_error ? theme.error : theme.ink;
    draw.AddRectFilled({at.x, y}, {at.x + width, y + height}, m.is_error ? theme.error_paper : theme.note_paper);
    draw.AddRectFilled({at.x, y}, {at.x + theme.px(4), y + height}, front);
    draw.AddLine({at.x, y + height - 1}, {at.x + width, y + height - 1}, theme.line);
    const float text = ImGui::CalcTextSize(m.text.c_str(), nullptr, false, text_width(width, theme)).y;
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + theme.px(16), y + 0.5f * (height - text)}, front,
                 m.text.c_str(), nullptr, text_width(width, theme));
    ImGui::SetCursorScreenPos(
        {at.x + width - ImGui::GetFrameHeight() * 1.15f - theme.px(10), y + 0.5f * (height - ImGui::GetFrameHeight())});
    ImGui::PushID(int(i));
    ButtonLook look;
    look.tip = "Dismiss";
    if (icon_button("dismiss", Icon::close, theme, look)) actions.push_back(DismissMessage{i});
    ImGui::PopID();
    y += height;
  }
  return actions;
}

}  // namespace odolab::ui
