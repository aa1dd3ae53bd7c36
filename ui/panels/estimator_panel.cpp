#include "ui/panels/estimator_panel.h"

#include <cmath>

#include "ui/floor/drawing.h"
#include "ui/look/figure_table.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void swatch(const EstimatorLook& look, const Theme& theme) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float y = at.y + 0.5f * ImGui::GetFrameHeight(), width = theme.px(26);
  draw_stroke(*ImGui::GetWindowDrawList(), {{at.x, y}, {at.x + width, y}}, look.colour, look.dash, theme);
  ImGui::Dummy({width, ImGui::GetFrameHeight()});
  ImGui::SameLine(0, theme.px(6));
}

void estimator_row(const EstimatorRow& r, EstimatorState& state, bool finished, const Theme& theme) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const float begin = ImGui::GetCursorPosX();
  bool shown_now = r.steers || state.shown.count(r.name) > 0;
  ImGui::BeginDisabled(r.steers);
  if (ImGui::Checkbox(("##" + r.name).c_str(), &shown_now)) {
    if (shown_now)
      state.shown.insert(r.name);
    else
      state.shown.erase(r.name);
  }
  ImGui::EndDisabled();
  std::string tip = r.about;
  if (r.steers) tip += "\n\nThe vehicle itself steers by this one; it is always shown.";
  if (finished)
    tip += "\n\nReturn error, true minus estimated: x " + shown(r.error_m.x_m, kMillimetres) + ", y " +
           shown(r.error_m.y_m, kMillimetres) + ", heading " + shown(-wrapped(r.gap.heading_rad), kDegrees) + ".";
  tooltip(tip, theme);
  ImGui::SameLine(0, theme.px(6));
  swatch(r.look, theme);
  ImGui::AlignTextToFramePadding();
  figure_label(r.name, shown_now ? theme.ink : theme.muted, ImGui::GetCursorPosX() - begin);
  tooltip(tip, theme);
  const Unit mm{"", 1e3, 1, 0.0}, degree{"", kDegrees.per_si, 2, 0.0};
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const double gap_m = length(r.gap.position());
  text_right(shown(gap_m, mm, gap_m < 0.9995 ? 1 : 0), shown_now ? r.look.colour : theme.muted);
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const double heading_rad = wrapped(r.gap.heading_rad);
  text_right(shown(heading_rad, degree, std::abs(heading_rad) < radians(99.995) ? 2 : 1),
             shown_now ? r.look.colour : theme.muted);
}

}  // namespace

EstimatorLook estimator_look(std::size_t index, const Theme& theme) {
  const ImU32 colours[] = {theme.blue, theme.green, theme.purple, theme.sky};
  const Dash dashes[] = {Dash::dots, Dash::long_dashes, Dash::dashes};
  return {colours[index % 4], dashes[index % 3]};  // no two of twelve are alike
}

void estimator_panel(const Estimators& e, EstimatorState& state, const Theme& theme) {
  heading(e.finished ? "Errors of the estimators at the end" : "Estimators side by side", theme);
  if (!begin_figures("estimators", {2.6f, 0.75f, 0.8f})) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  text_right("mm", theme.muted);
  tooltip("How far the estimated position is from the true one.", theme);
  ImGui::TableNextColumn();
  text_right("°", theme.muted);
  tooltip("How far the estimated heading is from the true one, in degrees.", theme);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(theme.px(2), theme.px(1)));  // a row is a line of text
  for (const EstimatorRow& r : e.rows) estimator_row(r, state, e.finished, theme);
  ImGui::PopStyleVar();
  end_figures();
}

}  // namespace odolab::ui
