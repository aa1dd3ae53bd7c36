#include "core/diagnosis/predicted_mismatch.h"

#include "core/calibration/left_out.h"
#include "core/calibration/restamped.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/mismatch.h"
#include "core/diagnosis/model/ready_run.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

namespace {

constexpr int kClockSteps = 4;  // of Gauss-Newton: the prediction is nearly linear in a clock's offset

// What acts on the clocks and on the truth stands in the model's numbers, not in motions.
void take_in(const std::vector<ActiveEffect>& effects, InnovationRun& run, TruthMounting& truth) {
  for (const ActiveEffect& a : effects) {
    if (a.effect == "clock_rate") put_clock_right(run, a.parameter("rate"), truth.time_offset_s);
    if (a.effect == "actuator_delay") put_later(run, a.parameter("delay_s"));
  }
  truth = truth_under(effects, truth);
}

// Where the filter has the axle, on the wheels' clock.
Track corrected_poses(const InnovationRun& run, const InnovationModel& model) {
  Track track;
  FilterOptions options;
  options.derivatives = false;
  options.on_step = [&](const FilterStep& s) {
    const double time_s = run.truth[static_cast<std::size_t>(s.truth_index)].time_s - model.truth.time_offset_s;
    track.push_back({time_s, s.pose});
  };
  filtered(run, summed_up(run, model), model, options);
  return track;
}

void fit_clock(const InnovationRun& run, InnovationModel& model) {
  for (int i = 0; i < kClockSteps; ++i) {
    const InnovationSums sums = filtered(run, summed_up(run, model), model);
    const std::size_t p = sums.score.size(), c = static_cast<std::size_t>(column::truth_clock);
    const double information = sums.information[c * p + c];
    if (!(information > 0.0)) return;
    model.truth.time_offset_s += sums.score[c] / information;
  }
}

}  // namespace

Result<Residuals> residuals_under(const FittedModel& model, const FittedNoise& noise, const Recording& recording,
                                  const Vehicle& nominal) {
  Vehicle vehicle = model.vehicle_in(recording.name);
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  if (!drive) return Error{recording.name, vehicle.name, "a differential drive"};
  const CheckedRecording ready = checked(recording, nominal);
  Result<InnovationRun> given = ready_run(ready, vehicle);
  if (!given) return given.error();
  const std::vector<ActiveEffect> effects = model.effects_in(recording.name);
  take_in(effects, *given, vehicle.truth);
  InnovationRun run = std::move(*given);
  cut_where_left_out(run, vehicle.truth.time_offset_s);
  InnovationModel frozen{*drive, vehicle.truth, noise};
  if (!effects.empty()) {
    const DriveView view =
        drive_view(0, run, frozen.drive, ready.from_commands, corrected_poses(run, frozen), Way::as_read);
    run.extra = {{"effects", 1.0, motions_of(view, effects)}};
  }
  fit_clock(run, frozen);
  cut_where_left_out(run, frozen.truth.time_offset_s);

  Residuals out;
  out.recording = recording.name;
  FilterOptions options;
  options.derivatives = false;
  options.on_step = [&](const FilterStep& s) {
    if (!s.used || s.starts) return;
    const Vec2 body = rotated({s.residual[0], s.residual[1]}, -s.heading_rad);
    out.time_s.push_back(run.truth[static_cast<std::size_t>(s.truth_index)].time_s);
    out.x_m.push_back(s.pose.x_m);
    out.y_m.push_back(s.pose.y_m);
    out.along_m.push_back(body.x_m);
    out.across_m.push_back(body.y_m);
    out.heading_rad.push_back(s.size == 3 ? s.residual[2] : 0.0);
  };
  std::vector<double> squared(run.truth.size(), 0.0);
  options.on_innovation = [&](const Innovation& i) {
    squared[static_cast<std::size_t>(i.truth_index)] = i.squared / i.size;
  };
  filtered(run, summed_up(run, frozen), frozen, options);
  for (std::size_t i = 0, k = 0; i < run.truth.size() && k < out.time_s.size(); ++i)
    if (run.truth[i].time_s == out.time_s[k]) {
      out.squared.push_back(squared[i]);
      ++k;
    }
  return out;
}

Diagnosis with_held_out_residuals(const Diagnosis& diagnosis, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal) {
  Diagnosis all = diagnosis;
  if (has_units(nominal)) return all;
  const FittedModel calibrated = calibrated_model_of(diagnosis), found = model_of(diagnosis);
  const FittedNoise noise = noise_of_pictures(diagnosis.calibration_alone.noise, diagnosis.calibration.noise);
  for (const Recording& recording : held_out) {
    Result<Residuals> before = residuals_under(calibrated, noise, recording, nominal);
    Result<Residuals> after = residuals_under(found, noise, recording, nominal);
    if (!before || !after || before->time_s.empty()) continue;
    all.residuals_before.push_back(std::move(*before));
    all.residuals_after.push_back(std::move(*after));
  }
  return all;
}

}  // namespace odolab
