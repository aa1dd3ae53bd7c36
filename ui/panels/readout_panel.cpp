#include "ui/panels/readout_panel.h"

#include <cmath>

#include "ui/look/figure_table.h"
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
  if (!begin_figures("poses", {0.7f, 1.0f, 1.0f})) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  header("true", theme.truth);
  tooltip("The pose on the floor: of the axle's centre, of linked trucks truck A's, of a platform its own.", theme);
  header("estimated", theme.orange);
  tooltip("What the robot believes, from its encoders alone: what it steers by unless a person sees where it is.",
          theme);
  const Pose &t = r.state.true_pose, &e = r.state.estimated_pose;
  const auto row = [&](const char* label, const std::string& true_text, const std::string& estimated) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(label, theme.ink);
    cell(true_text, theme.truth);
    cell(estimated, theme.orange);
  };
  row("x", shown(t.x_m, kMetres, 4), shown(e.x_m, kMetres, 4));
  row("y", shown(t.y_m, kMetres, 4), shown(e.y_m, kMetres, 4));
  // However often it has turned; the estimate beside the truth, not a turn away from it.
  const double heading_rad = wrapped(t.heading_rad);
  row("heading", shown(heading_rad, kDegrees), shown(heading_rad + wrapped(e.heading_rad - t.heading_rad), kDegrees));
  end_figures();
}

const Unit kTreadSpeed{"mm/s", 1e3, 1, 0.0}, kNewton{"N", 1.0, 1, 0.0};
constexpr const char* kSpeedTip = "Of the tread: wheel speed times its true radius.";
constexpr const char* kSlipTip = "Tread against floor, along the wheel.";
constexpr const char* kTractionTip = "Force of the floor on the wheel, along it.";

const char* ground_under(const WheelState& s) {
  return s.on_bump ? "on a bump" : s.in_slip_zone ? "slippery" : "floor";
}

// Of two wheels, side by side.
void wheel_pair_table(const Readout& r, const Theme& theme) {
  if (!begin_figures("wheels", {0.7f, 1.0f, 1.0f})) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  header("left", theme.muted);
  header("right", theme.muted);
  const WheelState &l = r.posture.wheels[0], &w = r.posture.wheels[1];
  const auto row = [&](const char* label, const std::string& left, const std::string& right, const char* tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(label, theme.ink);
    tooltip(tip, theme);
    cell(left, theme.ink);
    cell(right, theme.ink);
  };
  row("speed", shown(l.speed_radps * r.shape->wheels[0].radius_m, kTreadSpeed),
      shown(w.speed_radps * r.shape->wheels[1].radius_m, kTreadSpeed), kSpeedTip);
  row("slip", shown(l.slip_speed_mps, kTreadSpeed, 2), shown(w.slip_speed_mps, kTreadSpeed, 2), kSlipTip);
  row("traction", shown(l.traction_n, kNewton), shown(w.traction_n, kNewton), kTractionTip);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  figure_label("stands on", theme.ink);
  cell(ground_under(l), l.on_bump || l.in_slip_zone ? theme.orange : theme.muted);
  cell(ground_under(w), w.on_bump || w.in_slip_zone ? theme.orange : theme.muted);
  end_figures();
}

// Of more wheels, below each other; the name of one that stands on something is orange.
void wheel_rows(const Readout& r, const Theme& theme) {
  if (!begin_figures("wheels", {1.45f, 0.75f, 0.7f, 0.8f})) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  header("speed", theme.muted);
  tooltip(std::string(kSpeedTip) + " In mm/s.", theme);
  header("slip", theme.muted);
  tooltip(std::string(kSlipTip) + " In mm/s.", theme);
  header("traction", theme.muted);
  tooltip(std::string(kTractionTip) + " In newtons.", theme);
  const Unit mmps{"", 1e3, 1, 0.0}, newton{"", 1.0, 1, 0.0};
  for (std::size_t i = 0; i < r.posture.wheels.size(); ++i) {
    const WheelState& w = r.posture.wheels[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(r.shape->wheels[i].name, w.on_bump || w.in_slip_zone ? theme.orange : theme.ink);
    tooltip(words_of(r.shape->wheels[i]) + ", " + ground_under(w), theme);
    cell(shown(w.speed_radps * r.shape->wheels[i].radius_m, mmps), theme.ink);
    cell(shown(w.slip_speed_mps, mmps), theme.ink);
    cell(shown(w.traction_n, newton), theme.ink);
  }
  end_figures();
}

void gauge_table(const Readout& r, const Theme& theme) {
  if (!begin_figures("gauges", {0.9f, 1.0f, 1.0f})) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  header("true", theme.truth);
  header("measured", theme.orange);
  tooltip("As the encoder reads it, its bias and its steps included; both at the last sample.", theme);
  for (std::size_t i = 0; i < r.posture.gauges.size(); ++i) {
    const GaugeShape& gauge = r.shape->gauges[i];
    const Unit& unit = gauge.is_length ? kMillimetres : kDegrees;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(gauge.name, theme.ink);
    cell(shown(r.posture.gauges[i].truth, unit), theme.truth);
    const double measured = r.posture.gauges[i].measured;
    cell(std::isnan(measured) ? "–" : shown(measured, unit), theme.orange);
  }
  end_figures();
}

}  // namespace

Actions readout_panel(const Readout& r, EstimatorState& estimators, const Theme& theme) {
  Actions actions;
  heading("Gap between estimate and truth", theme);
  const Unit& unit = r.gap_m < 0.9995 ? kMillimetres : kMetres;
  const float half = 0.5f * ImGui::GetContentRegionAvail().x;
  big_figure(shown(r.gap_m, unit), "position", theme.orange, half, theme);
  ImGui::SameLine(0, 0);
  big_figure(shown(r.gap_heading_rad, kDegrees), "heading", theme.orange, half, theme);
  note(shown(std::abs(r.gap_along_m), unit) + (r.gap_along_m >= 0.0 ? " ahead, " : " behind, ") +
           shown(std::abs(r.gap_across_m), unit) + (r.gap_across_m >= 0.0 ? " left" : " right"),
       theme);
  heading("Poses", theme);
  pose_table(r, theme);
  if (!r.estimators.rows.empty()) estimator_panel(r.estimators, estimators, theme);
  if (r.shape && !r.posture.gauges.empty()) {
    heading("Joints", theme);
    gauge_table(r, theme);
  }
  if (r.shape) {
    heading("Wheels", theme);
    if (r.posture.wheels.size() == 2)
      wheel_pair_table(r, theme);
    else
      wheel_rows(r, theme);
  }
  ImGui::Dummy({1, theme.px(2)});
  ButtonLook hand;
  hand.toggled = r.by_hand;
  hand.tip = r.by_hand    ? "Back to the path that was driven before."
             : r.sideways ? "Take the wheel: drive with the arrow keys or W A S D, sideways with Q and E."
                          : "Take the wheel: drive with the arrow keys or W A S D.";
  const char* driven = r.sideways ? "Driven by hand: arrows, Q and E" : "Driven by hand: arrow keys";
  if (text_button(r.by_hand ? driven : "Drive by hand", theme, hand, -1.0f))
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
