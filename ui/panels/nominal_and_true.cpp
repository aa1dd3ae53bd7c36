#include "ui/panels/nominal_and_true.h"

namespace odolab::ui {

void nominal_and_true_columns(float label_weight, const Theme& theme) {
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, label_weight);
  ImGui::TableSetupColumn("nominal", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableSetupColumn("true", ImGuiTableColumnFlags_WidthStretch, 1.0f);
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
