#include "ui/panels/run_panel.h"

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

Edited sensor_fields(Scenario& s, const Theme& theme) {
  Edited result = number_row(
      "Encoders every",
      {"##encoders", kMilliseconds, 0.001, 1.0, "The encoders are read, and odometry and the driver run, this often."},
      s.sensors.encoder_period_s, theme);
  result = more(
      result,
      number_row(
          "Truth every",
          {"##truth", kMilliseconds, 0.0, 10.0,
           "Outside measurement of the pose; 0: only at the start and the end, as with the report's sonar corner."},
          s.sensors.truth_period_s, theme));
  result = more(result, number_row("Truth noise",
                                   {"##noise",
                                    {"mm", 1e3, 1, 0.02},
                                    0.0,
                                    1.0,
                                    "Standard deviation of the measured position; the report's sonar corner has 2 mm."},
                                   s.sensors.truth_position_noise_m, theme));
  result = more(result, number_row("… heading",
                                   {"##heading", kDegrees, 0.0, 1.0,
                                    "Standard deviation of the measured heading; the report's sonar corner has 0.4°."},
                                   s.sensors.truth_heading_noise_rad, theme));
  return result;
}

}  // namespace

Actions run_panel(Scenario& draft, bool& editing, const Theme& theme) {
  Actions actions;
  Edited result = Edited::no;
  ImGui::PushID("run");
  if (section("Sensors and run", theme, false)) {
    result = more(result, sensor_fields(draft, theme));
    result = more(result, number_row("Time step", {"##step", kMilliseconds, 0.0001, 0.01, "Step of the physics."},
                                     draft.step_s, theme));
    double seed = double(draft.seed);
    const Edited e = number_row(
        "Seed", {"##seed", {"", 1.0, 0, 0.1}, 0.0, 1e9, "The same scenario and seed give the same run, bit for bit."},
        seed, theme);
    draft.seed = std::uint64_t(seed);
    result = more(result, e);
  }
  ImGui::PopID();
  if (result == Edited::changing) editing = true;
  if (result == Edited::done) actions.push_back(EditScenario{draft});
  return actions;
}

}  // namespace odolab::ui
