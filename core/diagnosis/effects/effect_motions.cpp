#include "core/diagnosis/effects/effect_motions.h"

#include <algorithm>

namespace odolab {

Motions motion_of(const Effect& effect, const DriveView& view, const std::vector<double>& shape,
                  const std::vector<double>& value) {
  Motions sum(view.steps.size());
  const std::vector<Motions> columns = effect.motions(view, shape);
  for (std::size_t k = 0; k < std::min(columns.size(), value.size()); ++k) columns[k].add_to(sum, value[k]);
  return sum;
}

std::vector<BodyMotion> motions_of(const DriveView& view, const std::vector<ActiveEffect>& effects) {
  std::vector<BodyMotion> sum(view.steps.size());
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
    for (std::size_t k = 0; k < motions.size(); ++k) motions[k].add_to(sum, value[k]);
  }
  return sum;
}

}  // namespace odolab
