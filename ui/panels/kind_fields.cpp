#include "ui/panels/kind_fields.h"

#include <algorithm>
#include <cmath>

#include "core/scenario/machine_parameters.h"
#include "ui/panels/nominal_and_true.h"

namespace odolab::ui {

namespace {

Unit unit_of_parameter(ParameterUnit unit, double value_si) {
  switch (unit) {
    case ParameterUnit::metres:
      return std::abs(value_si) >= 0.2 ? Unit{"mm", 1e3, 1, 0.05} : Unit{"mm", 1e3, 2, 0.02};
    case ParameterUnit::radians:
      return {"°", kDegrees.per_si, 2, 0.01};
    case ParameterUnit::radians_per_metre:
      return {"mrad/m", 1e3, 2, 0.005};
    case ParameterUnit::ratio:
      return {"", 1.0, 4, 0.0005};
    case ParameterUnit::share:
      return {"%", 100.0, 3, 0.001};
    case ParameterUnit::count:
      return {"", 1.0, 0, 1.0};
    case ParameterUnit::kilograms:
      return kKilograms;
    case ParameterUnit::kilogram_square_metres:
      return kInertia;
    case ParameterUnit::hertz:
      return {"Hz", 1.0, 2, 0.01};
  }
  return kCoefficient;
}

Edited parameter_row(const VehicleParameter& nominal, const VehicleParameter& real, const Theme& theme) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  words(nominal.label, theme.ink);
  tooltip(nominal.about, theme);
  ImGui::PushID(nominal.label.c_str());
  ImGui::TableNextColumn();
  const Unit unit = unit_of_parameter(nominal.unit, *nominal.value);
  Edited result = number_field(
      {"##nominal", unit, 0.0, 0.0, nominal.about + "\n\nNominal: the number that the vehicle's odometry works with."},
      *nominal.value, -1.0f, theme);
  ImGui::TableNextColumn();
  if (real.machine_has_its_own)
    result = more(result,
                  number_field({"##true", unit, 0.0, 0.0, real.about + "\n\nTrue: what the machine really measures."},
                               *real.value, -1.0f, theme));
  else
    text_right("–", theme.muted);
  ImGui::PopID();
  return result;
}

// Both lists are alike; rows of one group stand in a table of their own.
Edited lengths(const std::vector<VehicleParameter>& nominal, const std::vector<VehicleParameter>& real,
               const Theme& theme) {
  Edited result = Edited::no;
  for (std::size_t i = 0; i < nominal.size();) {
    const std::string& group = nominal[i].group;
    std::size_t end = i;
    while (end < nominal.size() && nominal[end].group == group) ++end;
    const bool open = group.empty() || ImGui::TreeNodeEx(group.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen);
    if (open && ImGui::BeginTable(("lengths" + group).c_str(), 3)) {
      float widest = 0.0f;
      for (std::size_t k = i; k < end; ++k)
        widest = std::max(widest, ImGui::CalcTextSize(nominal[k].label.c_str()).x + theme.px(1));
      nominal_and_true_columns(0.9f, widest, theme);
      ImGui::PushID(group.c_str());
      for (; i < end; ++i) result = more(result, parameter_row(nominal[i], real[i], theme));
      ImGui::PopID();
      ImGui::EndTable();
    }
    i = end;
  }
  return result;
}

Edited machine(Scenario& draft, const Theme& theme) {
  Edited result = Edited::no;
  std::string group;
  for (const VehicleParameter& p : machine_parameters_of(draft)) {
    if (p.group != group) ImGui::TextDisabled("%s", p.group.c_str());
    group = p.group;
    ImGui::PushID(group.c_str());
    result = more(result,
                  number_row(p.label.c_str(), {p.label.c_str(), unit_of_parameter(p.unit, *p.value), 0.0, 0.0, p.about},
                             *p.value, theme));
    ImGui::PopID();
  }
  if (ImGui::Checkbox("Ideal motors", &draft.motor.ideal)) result = Edited::done;
  tooltip("The wheels turn exactly as told. Otherwise a speed controller with a torque limit drives them.", theme);
  if (ImGui::Checkbox("Steered by eye", &draft.driving.by_eye)) result = Edited::done;
  tooltip("The driver sees where the vehicle really is, as with a joystick; otherwise its own odometry steers it.",
          theme);
  return result;
}

}  // namespace

Edited kind_fields(Scenario& draft, const Theme& theme) {
  VehicleKind real = draft.machine.lengths.value_or(draft.vehicle.kind);
  Edited result = lengths(parameters_of(draft.vehicle.kind), parameters_of(real), theme);
  if (result != Edited::no) draft.machine.lengths = real;
  if (ImGui::TreeNodeEx("More of the machine", ImGuiTreeNodeFlags_NoTreePushOnOpen))
    result = more(result, machine(draft, theme));
  ButtonLook drawn;
  drawn.tip = "Make the machine just as its drawing says: no systematic error is left.";
  if (text_button("Make it as drawn", theme, drawn, -1.0f)) {
    draft.machine.lengths.reset();
    draft.machine.synchro.radius_error = {};
    draft.machine.synchro.misalignment_rad = {};
    draft.machine.link.length_eccentricity_m = 0.0;
    result = Edited::done;
  }
  return result;
}

}  // namespace odolab::ui
