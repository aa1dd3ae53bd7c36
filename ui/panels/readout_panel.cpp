#include "ui/panels/readout_panel.h"

#include <cmath>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void big_figure(const std::string& figure, const char* words, ImU32 colour, float width, const Theme& theme) {
  ImGui::BeginGroup();
  {
    WithFont large(theme.large);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(figure.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - theme.px(4));
  ImGui::TextDisabled("%s", words);
  ImGui::SameLine(0, 0);
  ImGui::Dummy({std::max(0.0f, width - ImGui::CalcTextSize(words).x - theme.px(2)), 1.0f});
  ImGui::EndGroup();
}

void cell(const std::string& text, ImU32 colour) {
  ImGui::TableNextColumn();
  text_right(text, colour);
}

void header(const char* text, ImU32 colour) {
  ImGui::TableNextColumn();
  text_right(text, colour);
}

void pose_table(const Readout& r, const Theme& theme) {
  if (!ImGui::BeginTable("poses", 3)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.7f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  header("true", theme.truth);
  tooltip("The pose of the axle's centre on the floor.", theme);
  header("estimated", theme.orange);
  tooltip("What the robot believes: dead reckoning from its encoders alone (UMBmark report, Eqs. 2.1 to 2.6).", theme);
  const Pose &t = r.state.true_pose, &e = r.state.estimated_pose;
  const auto row = [&](const char* label, const std::string& true_text, const std::string& estimated) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(label);
    cell(true_text, theme.truth);
    cell(estimated, theme.orange);
  };
  row("x", shown(t.x_m, kMetres, 4), shown(e.x_m, kMetres, 4));
  row("y", shown(t.y_m, kMetres, 4), shown(e.y_m, kMetres, 4));
  row("heading", shown(t.heading_rad, kDegrees), shown(e.heading_rad, kDegrees));
  ImGui::EndTable();
}

void wheel_table(const Readout& r, const Theme& theme) {
  if (!ImGui::BeginTable("wheels", 3)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.7f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  header("left", theme.muted);
  header("right", theme.muted);
  const WheelState &l = r.state.left, &w = r.state.right;
  const auto row = [&](const char* label, const std::string& left, const std::string& right, const char* tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(label);
    tooltip(tip, theme);
    cell(left, theme.ink);
    cell(right, theme.ink);
  };
  const Unit mmps{"mm/s", 1e3, 1, 0.0}, newton{"N", 1.0, 1, 0.0};
  row("speed", shown(l.speed_radps * r.wheel_radius_left_m, mmps), shown(w.speed_radps * r.wheel_radius_right_m, mmps),
      "Of the tread: wheel speed times its true radius.");
  row("slip", shown(l.slip_speed_mps, mmps, 2), shown(w.slip_speed_mps, mmps, 2),
      "Tread against floor, along the wheel.");
  row("traction", shown(l.traction_n, newton), shown(w.traction_n, newton),
      "Force of the floor on the wheel, along it.");
  const auto on = [](const WheelState& s) { return s.on_bump ? "on a bump" : s.in_slip_zone ? "slippery" : "floor"; };
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("stands on");
  cell(on(l), l.on_bump || l.in_slip_zone ? theme.orange : theme.muted);
  cell(on(w), w.on_bump || w.in_slip_zone ? theme.orange : theme.muted);
  ImGui::EndTable();
}

}  // namespace

Actions readout_panel(const Readout& r, const Theme& theme) {
  Actions actions;
  heading("Gap between estimate and truth", theme);
  const float half = 0.5f * ImGui::GetContentRegionAvail().x;
  big_figure(shown(r.gap_m, kMillimetres), "position", theme.orange, half, theme);
  ImGui::SameLine(0, 0);
  big_figure(shown(r.gap_heading_rad, kDegrees), "heading", theme.orange, half, theme);
  note(shown(std::abs(r.gap_along_m), kMillimetres) + (r.gap_along_m >= 0.0 ? " ahead, " : " behind, ") +
           shown(std::abs(r.gap_across_m), kMillimetres) + (r.gap_across_m >= 0.0 ? " left" : " right"),
       theme);
  heading("Poses", theme);
  pose_table(r, theme);
  heading("Wheels", theme);
  wheel_table(r, theme);
  ImGui::Dummy({1, theme.px(2)});
  ButtonLook hand;
  hand.toggled = r.by_hand;
  hand.tip =
      r.by_hand ? "Back to the path that was driven before." : "Take the wheel: drive with the arrow keys or W A S D.";
  if (text_button(r.by_hand ? "Driven by hand: arrow keys" : "Drive by hand", theme, hand, -1.0f))
    actions.push_back(DriveByHandInstead{!r.by_hand});
  return actions;
}

Actions welcome_card(Welcome& welcome, const Theme& theme) {
  Actions actions;
  if (!welcome.open) return actions;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, pad = theme.px(10);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.ChannelsSplit(2);
  draw.ChannelsSetCurrent(1);
  ImGui::SetCursorScreenPos({at.x + pad, at.y + pad});
  ImGui::BeginGroup();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width - 2.0f * pad);
  {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted("Three things to try");
  }
  static const char* kTries[] = {
      "Drag the yellow cable out of the way, and restart (R).",
      "Path, on the left: drive clockwise. The gap grows many times over.",
      "Calibrate, above: squares both ways tell why.",
  };
  for (int i = 0; i < 3; ++i) {
    ImGui::Text("%d", i + 1);
    ImGui::SameLine(0, theme.px(10));
    ImGui::TextUnformatted(kTries[i]);
  }
  ImGui::PopTextWrapPos();
  ImGui::EndGroup();
  const float bottom = ImGui::GetItemRectMax().y + pad;
  const float side = ImGui::GetFrameHeight();
  ImGui::SetCursorScreenPos({at.x + width - side * 1.15f - theme.px(4), at.y + theme.px(4)});
  ButtonLook look;
  look.tip = "Close this card";
  if (icon_button("close", Icon::close, theme, look)) welcome.open = false;
  draw.ChannelsSetCurrent(0);
  draw.AddRectFilled(at, {at.x + width, bottom}, theme.note_paper, theme.px(5));
  draw.AddRect(at, {at.x + width, bottom}, theme.line, theme.px(5));
  draw.ChannelsMerge();
  ImGui::SetCursorScreenPos({at.x, bottom + theme.px(4)});
  ImGui::Dummy({1, 1});
  return actions;
}

}  // namespace odolab::ui
