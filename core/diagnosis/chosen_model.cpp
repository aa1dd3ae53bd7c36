#include "core/diagnosis/chosen_model.h"

#include <algorithm>

#include "core/calibration/restamped.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/model/ready_run.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

namespace {

// The runs with the effects of the model put in, each at the size that was found. A clock's rate is in the stamps.
Result<std::vector<InnovationRun>> runs_with(const FittedModel& model, const std::vector<CheckedRecording>& ready,
                                             const LeastSquaresCalibration& alone, const Vehicle& nominal) {
  std::vector<InnovationRun> runs;
  std::vector<char> commands;
  for (const CheckedRecording& c : ready) {
    Result<InnovationRun> run = ready_run(c, nominal);
    if (!run) return run.error();
    run->accelerations = wheel_accelerations(run->wheels);
    const double offset_s = nominal.truth.time_offset_s;
    for (const ActiveEffect& a : model.effects_in(c.recording.name))
      if (a.effect == "clock_rate") put_clock_right(*run, a.parameter("rate"), offset_s);
    runs.push_back(std::move(*run));
    commands.push_back(c.from_commands);
  }
  JointModel joint(runs, commands, alone, nominal);
  joint.linearise();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<ActiveEffect> effects = model.effects_in(ready[r].recording.name);
    if (effects.empty()) continue;
    const int number = static_cast<int>(r);
    const DriveView read =
        drive_view(number, runs[r], joint.model_of(number).drive, commands[r] != 0, joint.poses(number), Way::as_read);
    runs[r].extra = {{"effects", 1.0, motions_of(read, effects)}};
  }
  return runs;
}

}  // namespace

bool can_be_switched_on(const Finding& f) {
  return f.effect != "unknown" && !is_data_fault(f.effect) && !is_of_the_truth(f.effect) &&
         f.effect.find("_bias") == std::string::npos;
}

bool any_is_put_in(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.findings.begin(), diagnosis.findings.end(), [](const Finding& f) {
    return f.effect != "unknown" && !is_data_fault(f.effect) && f.effect != "truth_mounting_offset" &&
           f.effect != "truth_time_offset";
  });
}

Result<FittedModel> model_with(const Diagnosis& diagnosis, const std::vector<bool>& on,
                               const std::vector<Recording>& train, const Vehicle& nominal) {
  Diagnosis chosen = diagnosis;
  chosen.findings.clear();
  bool all = true, any = false;
  for (std::size_t k = 0; k < diagnosis.findings.size(); ++k) {
    const Finding& f = diagnosis.findings[k];
    const bool is_on = k < on.size() && on[k];
    if (is_on || !can_be_switched_on(f)) chosen.findings.push_back(f);
    if (!can_be_switched_on(f)) continue;
    all = all && is_on;
    any = any || is_on;
  }
  if (!any) return calibrated_model_of(diagnosis);
  FittedModel model = model_of(chosen);
  if (all || has_units(nominal)) return model;

  std::vector<CheckedRecording> ready;
  std::vector<char> commands;
  for (const Recording& r : train) {
    ready.push_back(checked(r, nominal));
    commands.push_back(ready.back().from_commands);
  }
  Result<std::vector<InnovationRun>> runs = runs_with(model, ready, diagnosis.calibration_alone, nominal);
  if (!runs) return runs.error();
  JointModel joint(std::move(*runs), commands, diagnosis.calibration_alone, nominal);
  joint.linearise();
  joint.gate();
  joint.fit(3);
  joint.fit_noise_and_all();
  model.vehicle.kind = joint.model.drive;
  model.vehicle.truth = joint.model.truth;
  // The fit knows a base that follows late as a truth that is late.
  double delay_s = 0.0;
  for (const FittedEffect& e : model.effects)
    if (e.active.effect == "actuator_delay") delay_s += e.active.parameter("delay_s");
  model.vehicle.truth.time_offset_s -= delay_s;
  model.truth_clock_s.clear();
  for (std::size_t r = 0; r < train.size(); ++r)
    model.truth_clock_s.emplace_back(train[r].name, joint.clock_s[r] - delay_s);
  return model;
}

}  // namespace odolab
