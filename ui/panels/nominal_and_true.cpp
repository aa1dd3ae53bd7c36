#include "ui/panels/nominal_and_true.h"

#include "ui/look/figure_table.h"

namespace odolab::ui {

void nominal_and_true_columns(float label_weight, float widest_label, const Theme& theme) {
  const float field = ImGui::CalcTextSize("000.00 mm").x + 0.5f * ImGui::GetStyle().FramePadding.x + theme.px(1);
  const float room = ImGui::GetContentRegionAvail().x - 4.0f * ImGui::GetStyle().CellPadding.x;
  const char* names[] = {"label", "nominal", "true"};
  const std::vector<float> widths = column_widths(room, {label_weight, 1.0f, 1.0f}, {widest_label, field, field});
  for (std::size_t i = 0; i < widths.size(); ++i)
    ImGui::TableSetupColumn(names[i], ImGuiTableColumnFlags_WidthStretch, widths[i]);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("nominal");
  tooltip("What the drawing says and the odometry uses.", theme);
  ImGui::TableNextColumn();
  ImGui::TextDisabled("true");
  tooltip("What the machine in the simulation really is.", theme);
}

}  // namespace odolab::ui
