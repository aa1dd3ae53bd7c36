#include "core/diagnosis/fitted_model.h"

#include <cstdio>

namespace odolab {

std::vector<ActiveEffect> FittedModel::effects_in(const std::string& recording) const {
  std::vector<ActiveEffect> active;
  for (const FittedEffect& effect : effects)
    if (effect.recording.empty() || effect.recording == recording) active.push_back(effect.active);
  return active;
}

Result<Done> fits(const FittedModel& model, const Vehicle& nominal) {
  if (model.vehicle.kind.index() != nominal.kind.index())
    return Error{"vehicle.kind", "another kind than the vehicle's", "the kind of the vehicle that is given beside the model"};
  const auto* fitted = std::get_if<DifferentialDrive>(&model.vehicle.kind);
  const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (!fitted || !drive) return Done{};
  if (fitted->counts_per_wheel_turn() != drive->counts_per_wheel_turn() || fitted->counter_bits != drive->counter_bits) {
    char found[96], expected[96];
    std::snprintf(found, sizeof found, "%g counts per wheel turn, %d bits", fitted->counts_per_wheel_turn(), fitted->counter_bits);
    std::snprintf(expected, sizeof expected, "the vehicle's %g counts, %d bits", drive->counts_per_wheel_turn(), drive->counter_bits);
    return Error{"vehicle.differential_drive", found, expected};
  }
  return Done{};
}

}  // namespace odolab
