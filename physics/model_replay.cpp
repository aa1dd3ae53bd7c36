#include "physics/model_replay.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

#include "core/base/parallel.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"
#include "core/diagnosis/obeyed_commands.h"
#include "core/diagnosis/units/unit_models.h"
#include "core/geometry/begins_anew.h"
#include "core/scenario/effect_catalogue.h"
#include "physics/replay.h"

namespace odolab {

namespace {

// Finer than the recordings are, of 10 to 200 samples a second; a simulation at 1 ms would take four times as long.
constexpr double kStep_s = 0.004;

bool has(const ActiveEffect& active, const std::string& name) {
  return std::any_of(active.parameters.begin(), active.parameters.end(),
                     [&](const auto& p) { return p.first == name; });
}

// To the last digit; other kinds are not compared.
bool is_the_same(const Vehicle& a, const Vehicle& b) {
  const auto *of_a = std::get_if<DifferentialDrive>(&a.kind), *of_b = std::get_if<DifferentialDrive>(&b.kind);
  if (!of_a || !of_b) return false;
  const auto numbers = [](const DifferentialDrive& drive, const TruthMounting& truth) {
    const Pose& mounting = truth.axle_T_tracked;
    return std::array{drive.wheel_radius_left_m,
                      drive.wheel_radius_right_m,
                      drive.wheelbase_m,
                      drive.counts_per_wheel_turn(),
                      static_cast<double>(drive.counter_bits),
                      mounting.x_m,
                      mounting.y_m,
                      mounting.heading_rad,
                      truth.time_offset_s};
  };
  return numbers(*of_a, a.truth) == numbers(*of_b, b.truth);
}

int form_of(const ActiveEffect& fitted) { return static_cast<int>(fitted.parameter("form")); }

// With wheels that have drifted since the session began: the simulation's own drift starts with the recording.
Vehicle as_it_sets_off(Vehicle vehicle, const std::vector<ActiveEffect>& effects, const Recording& recording) {
  auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  if (!drive || recording.time_s.empty()) return vehicle;
  for (const ActiveEffect& a : effects) {
    if (a.effect != "radius_drift" || !has(a, kSessionStart)) continue;
    const double grown =
        1.0 + a.parameter("per_s") * effects::drifted(recording.time_s.front() - a.parameter(kSessionStart),
                                                      effects::drift_time_constant_s(form_of(a)));
    if (a.component != "right_wheel") drive->wheel_radius_left_m *= grown;
    if (a.component != "left_wheel") drive->wheel_radius_right_m *= grown;
  }
  return vehicle;
}

}  // namespace

// Of the truth's samples, those behind a time in which the way is not known begin anew.
std::optional<TrackError> error_where_known(const Replay& replay, const WaysUnknown& unknown,
                                            const std::string& recording) {
  if (!replay.truth_has_headings) return std::nullopt;
  const auto of_recording = unknown.find(recording);
  if (of_recording == unknown.end()) return replay.simulated_error;
  return track_error(replay.simulated, replay.truth, begins_anew(replay.truth, of_recording->second));
}

std::optional<ActiveEffect> effect_for_scenario(const ActiveEffect& fitted, const Recording& recording) {
  std::optional<ActiveEffect> playable = as_in_a_scenario(fitted);
  if (!playable) return std::nullopt;
  ActiveEffect& active = *playable;
  if (const double end_s = fitted.effect == "radius_drift" ? effects::drift_time_constant_s(form_of(fitted)) : 0.0;
      end_s > 0.0) {
    active.parameters.emplace_back("time_constant_s", end_s);
    if (has(fitted, kSessionStart) && !recording.time_s.empty())  // the simulation's own begins with the recording
      for (auto& [name, value] : active.parameters)
        if (name == "per_s") value *= std::exp(-(recording.time_s.front() - fitted.parameter(kSessionStart)) / end_s);
  }
  if (fitted.effect == "payload_radius_change" && !recording.time_s.empty())
    for (auto& [name, value] : active.parameters)
      if (name == "at_s") value = effects::put_on_s(value, recording.time_s.front());
  return playable;
}

std::optional<FitFigures> joined_figures(const std::vector<std::optional<TrackError>>& errors,
                                         const std::optional<FitFigures>& noise_floor) {
  double position = 0.0, heading = 0.0;
  int windows = 0;
  for (const std::optional<TrackError>& e : errors) {
    if (!e) continue;
    position += e->windows * e->position_rms_m * e->position_rms_m;
    heading += e->windows * e->heading_rms_rad * e->heading_rms_rad;
    windows += e->windows;
  }
  if (windows == 0) return std::nullopt;
  position /= windows;
  heading /= windows;
  FitFigures figures{std::sqrt(position), std::sqrt(heading), std::numeric_limits<double>::quiet_NaN()};
  if (noise_floor && noise_floor->position_rms_m > 0.0) {
    figures.normalised_chi2 = position / (noise_floor->position_rms_m * noise_floor->position_rms_m);
    if (noise_floor->heading_rms_rad > 0.0)
      figures.normalised_chi2 =
          (2.0 * figures.normalised_chi2 + heading / (noise_floor->heading_rms_rad * noise_floor->heading_rms_rad)) /
          3.0;
  }
  return figures;
}

// Each unit of a linked or castor vehicle driven alone by its own wheels: the joints say where it should come to.
static Result<ModelReplay> replay_units(const std::vector<Recording>& recordings, const Vehicle& file,
                                        const FittedModel& before, const FittedModel& after,
                                        const std::optional<FitFigures>& noise_floor, const Progress& progress,
                                        const WaysUnknown& unknown) {
  ModelReplay result;
  const std::size_t units = units_of(after.vehicle).size();
  const auto add = [&](std::optional<FitFigures>& sum, const std::optional<FitFigures>& one) {
    if (!one) return;
    if (!sum) sum = FitFigures{};
    const double share = 1.0 / static_cast<double>(units);
    sum->position_rms_m =
        std::sqrt(sum->position_rms_m * sum->position_rms_m + share * one->position_rms_m * one->position_rms_m);
    sum->heading_rms_rad =
        std::sqrt(sum->heading_rms_rad * sum->heading_rms_rad + share * one->heading_rms_rad * one->heading_rms_rad);
    sum->normalised_chi2 += share * one->normalised_chi2;
  };
  for (std::size_t u = 0; u < units; ++u) {
    const Progress part = [&](double share) {
      return goes_on(progress, (static_cast<double>(u) + share) / static_cast<double>(units));
    };
    Result<ModelReplay> one = replay_model(recordings_of_unit(recordings, after, u), file, model_of_unit(before, u),
                                           model_of_unit(after, u), noise_floor, part, unknown);
    if (!one) return one.error();
    add(result.fit.calibrated, one->fit.calibrated);
    add(result.fit.with_findings, one->fit.with_findings);
    for (std::string& sentence : one->not_switched_on) result.not_switched_on.push_back(std::move(sentence));
  }
  return result;
}

Result<ModelReplay> replay_model(const std::vector<Recording>& recordings, const Vehicle& file,
                                 const FittedModel& before, const FittedModel& after,
                                 const std::optional<FitFigures>& noise_floor, const Progress& progress,
                                 const WaysUnknown& unknown) {
  if (has_units(after.vehicle)) return replay_units(recordings, file, before, after, noise_floor, progress, unknown);
  ModelReplay result;
  const auto switched_on = [&](const FittedEffect& effect) {
    return std::any_of(recordings.begin(), recordings.end(), [&](const Recording& recording) {
      return (effect.recording.empty() || effect.recording == recording.name) &&
             effect_for_scenario(effect.active, recording);
    });
  };
  for (const FittedEffect& effect : after.effects)
    if (!is_of_the_truth(effect.active.effect) && !switched_on(effect))
      result.not_switched_on.push_back(effect.active.effect + " of " + effect.active.component +
                                       " could not be switched on in the simulator");

  // Where nothing was found that the simulator could show, the second replay is the first.
  const auto changes = [&](const Recording& recording) {
    const Vehicle with = after.vehicle_in(recording.name);
    if (!is_the_same(before.vehicle_in(recording.name), with)) return true;
    const std::vector<ActiveEffect> effects = after.effects_in(recording.name);
    return std::any_of(effects.begin(), effects.end(),
                       [&](const ActiveEffect& active) { return effect_for_scenario(active, recording).has_value(); });
  };
  const std::size_t count = recordings.size();
  const bool any_change = std::any_of(recordings.begin(), recordings.end(), changes);
  std::vector<std::optional<TrackError>> errors(2 * count);  // before, then after
  std::vector<std::optional<Error>> failures(2 * count);
  const auto drive = [&](int job, const std::atomic<bool>& stopped) {
    const std::size_t i = static_cast<std::size_t>(job) % count;
    const FittedModel& model = static_cast<std::size_t>(job) < count ? before : after;
    const Recording& recording = recordings[i];
    const Result<Replay> replayed =
        replay_with(model, file, std::make_shared<const Recording>(recording), [&](double) { return !stopped; });
    if (replayed)
      errors[static_cast<std::size_t>(job)] = error_where_known(*replayed, unknown, recording.name);
    else
      failures[static_cast<std::size_t>(job)] = replayed.error();
  };
  const int jobs = static_cast<int>(any_change ? 2 * count : count);
  // Short ones may all be done before anybody asks.
  if (!goes_on(progress, 0.0) || parallel_for(jobs, drive, {}, progress) < jobs)
    return Error{"the simulation", "a stop by its user", "to come to the end"};
  for (const std::optional<Error>& failure : failures)
    if (failure) return *failure;
  if (!any_change) std::copy_n(errors.begin(), count, errors.begin() + static_cast<std::ptrdiff_t>(count));
  result.fit.calibrated =
      joined_figures({errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(count)}, noise_floor);
  result.fit.with_findings =
      joined_figures({errors.begin() + static_cast<std::ptrdiff_t>(count), errors.end()}, noise_floor);
  return result;
}

Result<Replay> replay_with(const FittedModel& model, const Vehicle& file,
                           const std::shared_ptr<const Recording>& recording, const Progress& progress) {
  const std::vector<ActiveEffect> effects = model.effects_in(recording->name);
  const Vehicle vehicle = as_it_sets_off(model.vehicle_in(recording->name), effects, *recording);
  Scenario scenario = replay_scenario(vehicle, *recording);
  scenario.step_s = kStep_s;
  // How the base follows its commands is known from the fit, and what its motors are is not.
  scenario.motor.ideal = true;
  for (const ActiveEffect& fitted : effects)
    if (const auto active = effect_for_scenario(fitted, *recording)) scenario.effects.push_back(*active);
  return replay(scenario, std::make_shared<const Recording>(with_obeyed_commands(*recording, file, vehicle)), progress);
}

}  // namespace odolab
