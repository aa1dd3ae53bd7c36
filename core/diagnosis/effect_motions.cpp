#include "core/diagnosis/effect_motions.h"

namespace odolab {

Motions motions_of(const DriveView& view, const std::vector<ActiveEffect>& effects) {
  Motions sum(view.steps.size());
  for (const ActiveEffect& a : effects) {
    const Effect* e = catalogue_entry(a);
    if (!e || e->clock_rate || (e->only_commands && !view.from_commands)) continue;
    std::vector<double> value, shape;
    if (e->from_parameters)
      value = e->from_parameters(a);
    else
      for (const Effect::Amplitude& p : e->amplitudes) value.push_back(a.parameter(p.name));
    for (const Effect::Amplitude& p : e->shapes) shape.push_back(p.name == "recording" ? 0.0 : a.parameter(p.name));
    if (e->forms.size() > 1) shape.push_back(a.parameter("form"));
    const std::vector<Motions> motions = e->motions(view, shape);
    for (std::size_t k = 0; k < motions.size(); ++k)
      for (std::size_t i = 0; i < motions[k].size(); ++i) {
        sum[i].forward_m += value[k] * motions[k][i].forward_m;
        sum[i].sideways_m += value[k] * motions[k][i].sideways_m;
        sum[i].turn_rad += value[k] * motions[k][i].turn_rad;
      }
  }
  return sum;
}

}  // namespace odolab
