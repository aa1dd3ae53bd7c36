#include "core/diagnosis/effects/effect_motions.h"

#include <algorithm>
#include <cmath>

namespace odolab {

Motions motion_of(const Effect& effect, const DriveView& view, const std::vector<double>& shape,
                  const std::vector<double>& value) {
  Motions sum(view.steps.size());
  const std::vector<Motions> columns = effect.motions(view, shape);
  for (std::size_t k = 0; k < std::min(columns.size(), value.size()); ++k) columns[k].add_to(sum, value[k]);
  return sum;
}

double displaces_m(const std::vector<DriveView>& views, const std::function<Motions(const DriveView&)>& motion) {
  constexpr double kMost = 0.9;
  std::vector<double> displaced_m;
  for (const DriveView& view : views) {
    const Motions moved = motion(view);
    BodyMotion gone;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const BodyMotion m = moved.at(i);
      gone = {gone.forward_m + m.forward_m, gone.sideways_m + m.sideways_m, gone.turn_rad + m.turn_rad};
      displaced_m.push_back(std::max(std::hypot(gone.forward_m, gone.sideways_m),
                                     0.5 * view.drive.wheelbase_m * std::abs(gone.turn_rad)));
    }
  }
  if (displaced_m.empty()) return 0.0;
  const auto most = displaced_m.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(displaced_m.size()));
  std::nth_element(displaced_m.begin(), most, displaced_m.end());
  return *most;
}

bool is_more_than_counts(double displaces_m, double count_rad, const std::vector<DriveView>& views) {
  constexpr double kCounts = 0.6;
  double radius_m = 0.0;
  for (const DriveView& v : views)
    radius_m = std::max({radius_m, v.drive.wheel_radius_left_m, v.drive.wheel_radius_right_m});
  return displaces_m > kCounts * count_rad * radius_m;
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
