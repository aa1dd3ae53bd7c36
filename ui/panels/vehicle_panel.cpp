#include "ui/panels/vehicle_panel.h"

#include <algorithm>
#include <cmath>

#include "core/vehicle/parameters.h"
#include "ui/panels/kind_fields.h"
#include "ui/panels/nominal_and_true.h"

namespace odolab::ui {

namespace {

// One parameter with its two values side by side.
Edited pair_row(const char* label, const char* id, const Unit& unit, double& nominal_si, double& true_si, double least,
                double most, const std::string& what, const Theme& theme) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  tooltip(what, theme);
  ImGui::PushID(id);
  ImGui::TableNextColumn();
  Edited result = number_field(
      {"##nominal", unit, least, most, what + "\n\nNominal: the number that the robot's odometry works with."},
      nominal_si, -1.0f, theme);
  ImGui::TableNextColumn();
  result = more(result, number_field({"##true", unit, least, most,
                                      what + "\n\nTrue: what the machine really measures; its odometry does not know."},
                                     true_si, -1.0f, theme));
  ImGui::PopID();
  return result;
}

Edited drive_table(DifferentialDrive& nominal, ActualDrive& actual, const Theme& theme) {
  Edited result = Edited::no;
  if (!ImGui::BeginTable("drive", 3)) return result;
  nominal_and_true_columns(0.72f, ImGui::CalcTextSize("Wheelbase").x + theme.px(1), theme);
  // On the screen the field's word is the wheel's diameter, as in the paper; inside it is the radius.
  double dl = 2.0 * nominal.wheel_radius_left_m, dr = 2.0 * nominal.wheel_radius_right_m;
  double tl = 2.0 * actual.wheel_radius_left_m, tr = 2.0 * actual.wheel_radius_right_m;
  const Unit mm{"mm", 1e3, 2, 0.02};
  const Unit coarse{"mm", 1e3, 1, 0.05};
  result =
      more(result, pair_row("Ø left", "left", mm, dl, tl, 0.002, 2.0,
                            "Diameter of the left wheel.\nUnequal diameters turn straight sides into arcs: type B, "
                            "Ed = D_R / D_L (UMBmark report, Eq. 6.24).",
                            theme));
  result =
      more(result, pair_row("Ø right", "right", mm, dr, tr, 0.002, 2.0,
                            "Diameter of the right wheel.\nUnequal diameters turn straight sides into arcs: type B, "
                            "Ed = D_R / D_L (UMBmark report, Eq. 6.24).",
                            theme));
  result =
      more(result,
           pair_row("Wheelbase", "base", coarse, nominal.wheelbase_m, actual.wheelbase_m, 0.01, 10.0,
                    "Distance of the two points where the wheels touch the floor.\nA wrong one makes turns too large "
                    "or too small: type A, Eb = b_actual / b_nominal (UMBmark report, Eq. 6.29).",
                    theme));
  ImGui::EndTable();
  if (result != Edited::no) {
    nominal.wheel_radius_left_m = 0.5 * dl;
    nominal.wheel_radius_right_m = 0.5 * dr;
    actual.wheel_radius_left_m = 0.5 * tl;
    actual.wheel_radius_right_m = 0.5 * tr;
  }
  return result;
}

}  // namespace

Actions vehicle_panel(Scenario& draft, bool& editing, const Theme& theme) {
  Actions actions;
  Edited result = Edited::no;
  if (section("Vehicle", theme)) {
    ImGui::PushID("vehicle");
    DifferentialDrive* nominal = std::get_if<DifferentialDrive>(&draft.vehicle.kind);
    ImGui::TextUnformatted(draft.vehicle.name.c_str());
    const std::string words = words_of(draft.vehicle.kind);
    if (ImGui::CalcTextSize((draft.vehicle.name + words).c_str()).x + theme.px(12) < ImGui::GetContentRegionAvail().x)
      ImGui::SameLine();
    ImGui::TextDisabled("%s", words.c_str());
    if (!nominal) result = kind_fields(draft, theme);
    if (nominal) {
      result = more(result, drive_table(*nominal, draft.actual, theme));
      if (ImGui::TreeNodeEx("More of the machine", ImGuiTreeNodeFlags_NoTreePushOnOpen)) {
        result = more(
            result, number_row("Counts a turn",
                               {"##counts",
                                {"", 1.0, 0, 5.0},
                                4.0,
                                1e7,
                                "Encoder pulses per turn of the encoder's shaft, Ce of Eq. 2.1 of the UMBmark report."},
                               nominal->encoder_counts_per_revolution, theme));
        result = more(result, number_row("Gear ratio",
                                         {"##gear",
                                          {"", 1.0, 2, 0.02},
                                          0.01,
                                          1e4,
                                          "Turns of the encoder's shaft for each turn of the wheel, n of Eq. 2.1."},
                                         nominal->gear_ratio, theme));
        result = more(
            result,
            number_row("Toe left",
                       {"##toe_left", kDegrees, -0.4, 0.4,
                        "Misalignment of the left wheel: its rolling direction against straight ahead, true value."},
                       draft.actual.toe_left_rad, theme));
        result = more(result,
                      number_row("Toe right",
                                 {"##toe_right", kDegrees, -0.4, 0.4, "Misalignment of the right wheel, true value."},
                                 draft.actual.toe_right_rad, theme));
        result = more(result, number_row("Mass", {"##mass", kKilograms, 0.5, 5000.0, "Mass of the whole vehicle."},
                                         draft.actual.mass_kg, theme));
        result = more(result, number_row("Inertia",
                                         {"##inertia", kInertia, 0.001, 5000.0,
                                          "Moment of inertia about the vertical axis through the axle's centre."},
                                         draft.actual.moment_of_inertia_kgm2, theme));
        result = more(
            result,
            number_row("Load on wheels",
                       {"##share",
                        {"%", 100.0, 0, 0.2},
                        0.05,
                        1.0,
                        "Share of the weight that the drive wheels carry; castors carry the rest. It limits traction."},
                       draft.actual.drive_wheel_load_share, theme));
        if (ImGui::Checkbox("Ideal motors", &draft.motor.ideal)) result = Edited::done;
        tooltip("The wheels turn exactly as told. Otherwise a speed controller with a torque limit drives them.",
                theme);
      }
      ButtonLook drawn;
      drawn.tip = "Make the machine just as its drawing says: no systematic error is left.";
      if (text_button("Make it as drawn", theme, drawn, -1.0f)) {
        const ActualDrive as_is = draft.actual;
        draft.actual = as_drawn(*nominal);
        draft.actual.mass_kg = as_is.mass_kg;
        draft.actual.moment_of_inertia_kgm2 = as_is.moment_of_inertia_kgm2;
        draft.actual.drive_wheel_load_share = as_is.drive_wheel_load_share;
        result = Edited::done;
      }
    }
    ImGui::PopID();
  }
  if (result == Edited::changing) editing = true;
  if (result == Edited::done) actions.push_back(EditScenario{draft});
  return actions;
}

}  // namespace odolab::ui
