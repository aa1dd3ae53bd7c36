#include "core/diagnosis/generic/radii_by_way.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/chi_square.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/hats.h"
#include "core/diagnosis/generic/unnamed_group.h"
#include "core/diagnosis/naming/lag_and_delay.h"

namespace odolab {

namespace {

bool is_load(const AcceptedEffect& a) { return a.effect->name == "payload_radius_change"; }
bool is_of_radii_in_time(const AcceptedEffect& a) { return is_load(a) || a.effect->name == "radius_drift"; }

// One drift alone may be any that goes one way.
bool may_be_another_law(const std::vector<AcceptedEffect>& names) {
  return std::any_of(names.begin(), names.end(), is_load) ||
         std::count_if(names.begin(), names.end(), is_of_radii_in_time) > 1;
}

// What a radius may go by, counted from the recording's start, and functions of that.
struct RadiusLaw {
  const char* variable;
  std::vector<double> (*count)(const DriveView&);  // of each step
  std::vector<std::function<double(double)>> functions;
  std::vector<double> drawn_at;
  int terms() const { return 2 * static_cast<int>(functions.size()); }  // of either wheel
};

std::vector<double> way_since_start_m(const DriveView& view) {
  std::vector<double> way_m;
  double so_far_m = 0.0;
  for (const EffectStep& s : view.steps) {
    so_far_m += s.rolled_m();
    way_m.push_back(so_far_m);
  }
  return way_m;
}

std::vector<double> time_since_start_s(const DriveView& view) {
  std::vector<double> time_s;
  for (const EffectStep& s : view.steps) time_s.push_back(s.since_start_s);
  return time_s;
}

// Hats but for the first: how large wheels are at the start is calibration's.
RadiusLaw by_hats(const char* variable, std::vector<double> (*count)(const DriveView&),
                  const std::vector<DriveView>& views) {
  constexpr std::size_t kHats = 8;
  RadiusLaw law{variable, count, {}, std::vector<double>(kHats)};
  double end = 0.0;
  for (const DriveView& v : views)
    if (!v.steps.empty()) end = std::max(end, count(v).back());
  for (std::size_t k = 0; k < kHats; ++k)
    law.drawn_at[k] = end * static_cast<double>(k) / static_cast<double>(kHats - 1);
  const Hats hats(law.drawn_at);
  for (std::size_t k = 1; k < kHats && end > 0.0; ++k)
    law.functions.push_back([hats, k](double x) { return hats.of(k, x); });
  return law;
}

RadiusLaw by_what_fades() {
  RadiusLaw law{
      "time since the start, forgotten over seconds", time_since_start_s, {}, {0.0, 2.5, 5.0, 10.0, 20.0, 40.0}};
  for (const double lasts_s : {5.0, 20.0})
    law.functions.push_back([lasts_s](double since_s) { return std::exp(-since_s / lasts_s); });
  return law;
}

std::vector<Motions> motions_of_radii(const DriveView& view, const RadiusLaw& law) {
  const std::size_t steps = view.steps.size(), count = law.functions.size();
  std::vector<Motions> out(2 * count, Motions(steps));
  const std::vector<double> at = law.count(view);
  for (std::size_t i = 0; i < steps; ++i) {
    const EffectStep& s = view.steps[i];
    for (std::size_t k = 0; k < count; ++k) {
      const double share = law.functions[k](at[i]);
      if (share == 0.0) continue;
      out[k][i] = by_wheel(Wheel::left, share * s.left_m, view.drive.wheelbase_m);
      out[count + k][i] = by_wheel(Wheel::right, share * s.right_m, view.drive.wheelbase_m);
    }
  }
  return out;
}

GenericTest as_group(const RadiusLaw& law) {
  const auto terms = static_cast<std::size_t>(law.terms());
  GenericTest group;
  group.variable = law.variable;
  group.channel = "size of the wheels";
  auto term = std::make_shared<Effect>();
  term->name = group.variable;
  term->component = group.channel;
  term->amplitudes.resize(terms);
  term->motions = [law](const DriveView& view, const std::vector<double>&) { return motions_of_radii(view, law); };
  group.as_effect = std::move(term);
  group.test.value.assign(terms, 0.0);
  for (const int wheel : {kLeftWheelAlone, kRightWheelAlone}) {
    std::vector<std::vector<double>> basis;
    for (const double at : law.drawn_at) {
      basis.emplace_back(terms, 0.0);
      for (std::size_t k = 0; k < law.functions.size(); ++k)
        basis.back()[k + (wheel == kLeftWheelAlone ? 0 : law.functions.size())] = law.functions[k](at);
    }
    group.curves.push_back({law.variable, name_of_channel(wheel), law.drawn_at, std::move(basis)});
  }
  return group;
}

}  // namespace

std::optional<Unnamed> what_radii_go_by_instead(const JointModel& joint) {
  constexpr double kByChance = 2.0;  // of twice the log-likelihood, for each term: twice of what it explains by chance
  if (!may_be_another_law(joint.accepted)) return std::nullopt;
  const RadiusLaw laws[] = {by_hats("way since the start [m]", way_since_start_m, joint.views()),
                            by_hats("time since the start [s]", time_since_start_s, joint.views()), by_what_fades()};
  JointModel unnamed = joint;
  std::erase_if(unnamed.accepted, is_of_radii_in_time);
  std::optional<Unnamed> found;
  double most = 0.0;
  for (const RadiusLaw& law : laws) {
    if (law.functions.empty()) continue;
    const GenericTest group = as_group(law);
    JointModel with = unnamed;
    with.accepted.push_back(
        {.effect = group.as_effect.get(), .shape = {}, .value = group.test.value, .is_damped = true});
    with.fit(3);
    const double under_noise_of_names = likelier_by(with, joint);
    with.fit_noise_and_all();
    JointModel names = joint.under(with.model.noise);
    names.fit(2);
    const double more = std::min(under_noise_of_names, likelier_by(with, names));
    const double beyond_chance = more - kByChance * law.terms();
    if (!(beyond_chance > most)) continue;
    most = beyond_chance;
    JointModel without = unnamed.under(with.model.noise);
    without.fit(3);
    found = unnamed_by(group, with, without, shape_of(group, with), likelier_by(with, without));
    found->p_value = std::size(laws) * chi_square_tail(more, law.terms());
  }
  return found;
}

}  // namespace odolab
