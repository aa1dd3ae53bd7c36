#include "core/diagnosis/units/merged_asked.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/chi_square.h"
#include "core/diagnosis/asked_effects.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/units/component_names.h"

namespace odolab {

namespace {

void keep_likeliest(std::vector<AskedEffect>& all, AskedEffect more) {
  const auto same = std::find_if(all.begin(), all.end(), [&](const AskedEffect& a) { return a.effect == more.effect; });
  if (same == all.end())
    all.push_back(std::move(more));
  else if (is_likelier(more, *same))
    *same = std::move(more);
}

AskedEffect asked_bias(const JointEstimate& e, int encoders) {
  AskedEffect a;
  a.effect = e.parameter.effect;
  a.component = e.parameter.component;
  if (!e.determined) return a;
  const double off = e.value - e.nominal, z = off / e.stderr_value;
  a.log_likelihood_gain = 0.5 * z * z;
  a.p_value = std::min(1.0, encoders * chi_square_tail(z * z, 1));
  a.least_seen = FoundParameter{e.parameter.parameter, std::max(kSigmasOfBias * e.stderr_value, e.least_bias()), 0.0,
                                e.parameter.unit};
  return a;
}

}  // namespace

std::vector<AskedEffect> merged_asked(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry,
                                      const std::vector<VehicleUnit>& units) {
  std::vector<AskedEffect> all;
  for (std::size_t u = 0; u < diagnoses.size(); ++u)
    for (AskedEffect a : diagnoses[u].asked) {
      a.component = component_of_unit(units[u].name, a.component);
      a.p_value = std::min(1.0, a.p_value * static_cast<double>(diagnoses.size()));
      keep_likeliest(all, std::move(a));
    }
  const auto encoders = static_cast<int>(
      std::count_if(geometry.joints.begin(), geometry.joints.end(), std::mem_fn(&JointEstimate::is_of_an_encoder)));
  for (const JointEstimate& e : geometry.joints)
    if (e.is_of_an_encoder()) keep_likeliest(all, asked_bias(e, encoders));
  std::stable_sort(all.begin(), all.end(), is_likelier);
  return all;
}

void mark_named(Diagnosis& of_vehicle) {
  std::erase_if(of_vehicle.not_testable, [&](const NotTestable& n) {
    return std::any_of(of_vehicle.findings.begin(), of_vehicle.findings.end(),
                       [&](const Finding& f) { return f.effect == n.effect; });
  });
  for (AskedEffect& a : of_vehicle.asked) {
    const auto found = std::find_if(of_vehicle.findings.begin(), of_vehicle.findings.end(),
                                    [&](const Finding& f) { return f.effect == a.effect; });
    a.named = found != of_vehicle.findings.end();
    if (!a.named) continue;
    a.component = found->component;
    a.log_likelihood_gain = found->log_likelihood_gain;
    a.p_value = found->p_value;
    a.gain_beside_findings.reset();
    a.least_seen.reset();
  }
  std::stable_sort(of_vehicle.asked.begin(), of_vehicle.asked.end(), is_likelier);
}

}  // namespace odolab
