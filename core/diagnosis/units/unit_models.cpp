#include "core/diagnosis/units/unit_models.h"

#include "core/calibration/smoothed_readings.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/joined_clocks.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

std::vector<ActiveEffect> effects_of_unit(const std::vector<ActiveEffect>& effects, const VehicleUnit& unit,
                                          const std::vector<VehicleUnit>& all) {
  std::vector<ActiveEffect> own;
  for (ActiveEffect active : effects) {
    if (active.effect == "clock_rate" && !carries_truth(all)) continue;  // it is in the recordings
    if (is_bias_of_a_joint(active.effect) || (active.component == "truth" && !unit.carries_truth)) continue;
    const std::optional<std::string> component = component_in_unit(unit.name, active.component, all);
    if (!component) continue;
    active.component = *component;
    own.push_back(std::move(active));
  }
  return own;
}

FittedModel model_of_unit(const FittedModel& model, std::size_t unit) {
  const std::vector<VehicleUnit> units = units_of(model.vehicle);
  FittedModel own{vehicle_of_unit(units[unit], model.vehicle), {}, {}, {}};
  if (units[unit].carries_truth) own.truth_clock_s = model.truth_clock_s;
  for (const FittedEffect& effect : model.effects)
    for (ActiveEffect& active : effects_of_unit({effect.active}, units[unit], units))
      own.effects.push_back({std::move(active), effect.stderr_values, effect.recording});
  return own;
}

std::vector<Recording> recordings_of_unit(const std::vector<Recording>& recordings, const FittedModel& model,
                                          std::size_t unit) {
  std::vector<Recording> own;
  for (const Recording& recording : recordings) {
    const Vehicle vehicle = model.vehicle_in(recording.name);
    const std::vector<UnitSample> samples = unit_samples(recording, vehicle);
    Track tracked = tracked_poses(recording);
    if (!carries_truth(units_of(vehicle)))
      for (const ActiveEffect& a : model.effects_in(recording.name))
        if (a.effect == "clock_rate") put_right(tracked, a.parameter("rate"));
    if (samples.size() < 2 || tracked.size() < 2) continue;
    own.push_back(
        recording_of_unit(recording, samples, tracked, vehicle, unit, 0.0, !units_of(vehicle)[unit].carries_truth));
  }
  return own;
}

InnovationRun run_of_wheels(const std::vector<UnitSample>& samples, std::size_t unit) {
  InnovationRun run;
  run.wheels = wheels_of(samples, unit);
  run.smooth = smoothed(run.wheels);
  run.truth = {TruthSample{run.wheels.front().time_s, {}, 0.0}};
  return run;
}

TrueUnits without_effects(const std::vector<UnitSample>& samples, const std::vector<VehicleUnit>& units,
                          const std::vector<std::vector<BodyMotion>>& motions) {
  TrueUnits result{samples, std::vector<std::vector<double>>(samples.size(), std::vector<double>(units.size(), 0.0))};
  for (std::size_t u = 0; u < units.size(); ++u) {
    const DifferentialDrive& drive = units[u].drive;
    WheelRotation more;
    for (std::size_t i = 1; i < samples.size() && i - 1 < motions[u].size(); ++i) {
      const BodyMotion& m = motions[u][i - 1];
      more.left_rad += (m.forward_m - 0.5 * drive.wheelbase_m * m.turn_rad) / drive.wheel_radius_left_m;
      more.right_rad += (m.forward_m + 0.5 * drive.wheelbase_m * m.turn_rad) / drive.wheel_radius_right_m;
      result.samples[i].wheels[u].left_rad += more.left_rad;
      result.samples[i].wheels[u].right_rad += more.right_rad;
      result.sideways_m[i][u] = m.sideways_m;
    }
  }
  return result;
}

}  // namespace odolab
