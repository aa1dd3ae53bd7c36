#include "app/gui/panes.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr ImGuiWindowFlags kPane = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                   ImGuiWindowFlags_NoNavFocus;

// Of the width, for both panes beside the middle, a floor or a guide's page.
constexpr float kMostAside = 0.70f, kMostBesidePage = 0.58f, kLeastLeft = 0.27f;
constexpr float kLeastMiddle = 250.0f, kLeastBottom = 130.0f;            // heights at scale 1
constexpr float kLeastMiddleWidth = 380.0f, kLeastRightOfPage = 240.0f;  // widths at scale 1

}  // namespace

Layout lay_out(const ScreenState& state, ImVec2 screen, bool has_bottom, bool on_page, const ui::Theme& theme) {
  Layout l;
  l.has_bottom = has_bottom;
  const float top = state.choices.hide_interface ? 0.0f : theme.px(40);
  const float bottom = has_bottom && !state.choices.hide_interface
                           ? std::min({theme.px(float(state.bottom_height)), 0.6f * screen.y,
                                       std::max(theme.px(kLeastBottom), screen.y - top - theme.px(kLeastMiddle))})
                           : 0.0f;
  float left = state.choices.hide_interface ? 0.0f : theme.px(float(state.left_width));
  float right = state.choices.hide_interface ? 0.0f : theme.px(float(state.right_width));
  // The middle is what people look at: the panes beside it give way, what stands to the right of it first, but not
  // below what their numbers need; a guide's page needs no such room beside it.
  const float needed = on_page ? 0.0f : theme.px(kLeftNeeds + kRightNeeds);
  const float most = std::min((on_page ? kMostBesidePage : kMostAside) * screen.x,
                              std::max({0.5f * screen.x, screen.x - theme.px(kLeastMiddleWidth), needed}));
  const float least_right = theme.px(on_page ? kLeastRightOfPage : kRightNeeds);
  right = std::round(std::min(right, std::max(most - left, std::min(right, least_right))));
  left = std::round(std::min(left, std::max(most - right, kLeastLeft * screen.x)));
  right = std::round(std::min(right, std::max(0.0f, most - left)));
  const float begin = top, height = std::max(40.0f, screen.y - begin - bottom);
  l.top_size = {screen.x, top};
  l.left_low = {0, begin};
  l.left_size = {left, height};
  l.centre_low = {left, begin};
  l.centre_size = {screen.x - left - right, height};
  l.right_low = {screen.x - right, begin};
  l.right_size = {right, height};
  l.bottom_low = {0, begin + height};
  l.bottom_size = {screen.x, bottom};
  return l;
}

void begin_pane(const char* name, ImVec2 low, ImVec2 size, bool padded, bool scrolls, ImU32 background, bool above,
                float needs) {
  ImGui::SetNextWindowPos(low);
  ImGui::SetNextWindowSize(size);
  const ImGuiStyle& style = ImGui::GetStyle();
  const bool sideways = size.x < needs;
  if (sideways) ImGui::SetNextWindowContentSize({needs - 2.0f * style.WindowPadding.x - style.ScrollbarSize, 0.0f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
  if (!padded) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGuiWindowFlags flags = kPane;
  if (scrolls) flags &= ~ImGuiWindowFlags_NoScrollbar;
  if (sideways) flags |= ImGuiWindowFlags_HorizontalScrollbar;
  if (above) flags = (flags & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleVar(padded ? 1 : 2);
  ImGui::PopStyleColor();
}

void splitter(const char* id, ImVec2 low, ImVec2 size, bool vertical, double& value, double grows_with, double least,
              double most, const ui::Theme& theme) {
  const float grab = theme.px(6);
  const ImVec2 at = vertical ? ImVec2(low.x - 0.5f * grab, low.y) : ImVec2(low.x, low.y - 0.5f * grab);
  const ImVec2 extent = vertical ? ImVec2(grab, size.y) : ImVec2(size.x, grab);
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(extent);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin(id, nullptr,
               (kPane & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("##grip", extent);
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (lit) ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemActive()) {
    const ImVec2 by = ImGui::GetIO().MouseDelta;
    value = std::clamp(value + grows_with * (vertical ? by.x : by.y) / theme.scale, least, most);
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = lit ? theme.px(3) : 1.0f;
  if (vertical)
    draw.AddRectFilled({std::round(low.x - 0.5f * line), low.y},
                       {std::round(low.x - 0.5f * line) + line, low.y + size.y}, lit ? theme.muted : theme.line);
  else
    draw.AddRectFilled({low.x, std::round(low.y - 0.5f * line)},
                       {low.x + size.x, std::round(low.y - 0.5f * line) + line}, lit ? theme.muted : theme.line);
  ImGui::End();
}

}  // namespace odolab
