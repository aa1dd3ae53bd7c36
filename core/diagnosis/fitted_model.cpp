#include "core/diagnosis/fitted_model.h"

#include <algorithm>

#include "core/base/formatted.h"
#include "core/recording/same_samples.h"

namespace odolab {

namespace {

constexpr double kBeforeAnyStart_s = -1e6;

bool has_parameter(const ActiveEffect& active, const std::string& name) {
  for (const auto& [key, value] : active.parameters)
    if (key == name) return true;
  return false;
}

}  // namespace

std::optional<std::string> FittedModel::fitted_as(const Recording& recording) const {
  if (!fingerprints.empty()) {
    const std::string own = fingerprint(recording);
    for (const auto& [name, of_it] : fingerprints)
      if (of_it == own) return name;
    return std::nullopt;
  }
  const auto is_own = [&](const std::string& name) { return name == recording.name; };
  for (const auto& [name, offset_s] : truth_clock_s)
    if (is_own(name)) return name;
  for (const FittedEffect& effect : effects)
    if (!effect.recording.empty() && is_own(effect.recording)) return effect.recording;
  return std::nullopt;
}

std::vector<ActiveEffect> FittedModel::effects_in(const std::string& recording) const {
  const bool has_clock =
      std::any_of(truth_clock_s.begin(), truth_clock_s.end(), [&](const auto& of) { return of.first == recording; });
  std::vector<ActiveEffect> active;
  for (const FittedEffect& effect : effects) {
    if (effect.active.effect == "truth_time_offset" && has_clock) continue;  // its own, and not the mean of all
    if (effect.recording.empty() || effect.recording == recording) active.push_back(effect.active);
  }
  return active;
}

Vehicle FittedModel::vehicle_in(const std::string& recording) const {
  Vehicle result = vehicle;
  for (const auto& [name, offset_s] : truth_clock_s)
    if (name == recording) result.truth.time_offset_s = offset_s;
  for (const FittedEffect& e : effects)
    if (e.active.effect == "truth_mounting_offset" && !e.recording.empty() && e.recording == recording)
      result.truth = truth_under({e.active}, result.truth);
  return result;
}

FittedModel model_of(const Diagnosis& diagnosis) {
  FittedModel model{diagnosis.fitted_vehicle.value_or(diagnosis.calibration.vehicle), {}, diagnosis.truth_clock_s, {}};
  for (const Finding& finding : diagnosis.findings) {
    if (finding.effect == "unknown" || is_data_fault(finding.effect)) continue;
    FittedEffect effect{finding.as_active(), {}, ""};
    // The fit has the crawl as a turned mounting; where it is the wheels', the mounting sits as it was drawn.
    if (finding.effect == "wheel_toe")
      model.vehicle.truth.axle_T_tracked.heading_rad += effect.active.parameter("sideways_per_metre");
    // And a base that follows late as a truth that is late, of its own in each recording.
    if (finding.effect == "actuator_delay") {
      const double delay_s = effect.active.parameter("delay_s");
      model.vehicle.truth.time_offset_s -= delay_s;
      for (auto& [recording, offset_s] : model.truth_clock_s) offset_s -= delay_s;
    }
    for (const FoundParameter& p : finding.parameters) effect.stderr_values.emplace_back(p.name, p.stderr_value);
    // phases of their own, each in its recording alone
    if (has_parameter(effect.active, "phase_rad_2")) {
      for (std::size_t r = 0; r < diagnosis.truth_clock_s.size(); ++r) {
        const std::string own = r == 0 ? "phase_rad" : "phase_rad_" + std::to_string(r + 1);
        FittedEffect in_one{{finding.effect, finding.component, {}}, {}, diagnosis.truth_clock_s[r].first};
        for (const FoundParameter& p : finding.parameters)
          if (p.name == "amplitude" || p.name == own) {
            const std::string name = p.name == own ? "phase_rad" : p.name;
            in_one.active.parameters.emplace_back(name, p.value);
            in_one.stderr_values.emplace_back(name, p.stderr_value);
          }
        model.effects.push_back(in_one);
      }
      continue;
    }
    // and so are rates
    if (has_parameter(effect.active, "rate_2")) {
      for (std::size_t r = 0; r < diagnosis.truth_clock_s.size(); ++r) {
        FittedEffect in_one{{finding.effect, finding.component, {}}, {}, diagnosis.truth_clock_s[r].first};
        for (const FoundParameter& p : finding.parameters)
          if (p.name == "rate_" + std::to_string(r + 1)) {
            in_one.active.parameters.emplace_back("rate", p.value);
            in_one.stderr_values.emplace_back("rate", p.stderr_value);
          }
        model.effects.push_back(in_one);
      }
      continue;
    }
    if (finding.effect == "truth_mounting_offset") effect.recording = finding.where.recording;
    // what is tied to a time and not to a place happened once
    if (has_parameter(effect.active, "at_s") && !has_parameter(effect.active, "x_m"))
      effect.recording = finding.where.recording;
    if (finding.where.and_later_recordings) {
      bool later = false;
      for (const auto& [recording, offset_s] : diagnosis.truth_clock_s) {
        if (later) {
          FittedEffect again = effect;
          again.recording = recording;
          for (auto& [key, value] : again.active.parameters)
            if (key == "at_s") value = kBeforeAnyStart_s;
          model.effects.push_back(again);
        }
        later = later || recording == finding.where.recording;
      }
    }
    model.effects.push_back(effect);
  }
  return model;
}

FittedModel model_of(const Diagnosis& diagnosis, const std::vector<Recording>& given) {
  FittedModel model = model_of(diagnosis);
  for (const Recording& recording : given)
    for (const auto& [name, offset_s] : diagnosis.truth_clock_s)
      if (name == recording.name) model.fingerprints.emplace_back(name, fingerprint(recording));
  return model;
}

FittedModel calibrated_model_of(const Diagnosis& diagnosis) {
  FittedModel model{diagnosis.calibration_alone.vehicle, {}, {}, {}};
  const std::vector<double>& clocks = diagnosis.calibration_alone.time_offset_s;
  for (std::size_t r = 0; r < std::min(clocks.size(), diagnosis.truth_clock_s.size()); ++r)
    model.truth_clock_s.emplace_back(diagnosis.truth_clock_s[r].first, clocks[r]);
  return model;
}

Result<Done> fits(const FittedModel& model, const Vehicle& nominal) {
  if (model.vehicle.kind.index() != nominal.kind.index())
    return Error{"vehicle.kind", "another kind than the vehicle's",
                 "the kind of the vehicle that is given beside the model"};
  const auto* fitted = std::get_if<DifferentialDrive>(&model.vehicle.kind);
  const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (!fitted || !drive) return Done{};
  if (fitted->counts_per_wheel_turn() != drive->counts_per_wheel_turn() ||
      fitted->counter_bits != drive->counter_bits) {
    constexpr const char* kCounts = "%g counts per wheel turn, %d bits";
    return Error{"vehicle.differential_drive",
                 formatted(kCounts, fitted->counts_per_wheel_turn(), fitted->counter_bits),
                 "the vehicle's " + formatted(kCounts, drive->counts_per_wheel_turn(), drive->counter_bits)};
  }
  return Done{};
}

}  // namespace odolab
