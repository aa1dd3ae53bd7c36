#include "core/diagnosis/simpler_forms.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/naming/shape_search.h"

namespace odolab {

namespace {

// Whether the tracked point sits where the vehicle's file has it, as far as a hand puts it there.
bool sits_as_given(const JointModel& joint, const Vehicle& nominal) {
  const Pose &now = joint.model.truth.axle_T_tracked, &given = nominal.truth.axle_T_tracked;
  const double least_m = sits_right_m(std::get<DifferentialDrive>(nominal.kind).wheelbase_m);
  const auto is_there = [&](int column, double by_m) {
    return std::abs(by_m) < std::max(least_m, kSigmasOfBias * joint.stderr_of_nuisance(column));
  };
  return is_there(column::mounting_x, now.x_m - given.x_m) && is_there(column::mounting_y, now.y_m - given.y_m);
}

JointModel in_form(JointModel joint, std::size_t name, std::size_t form, const CandidateTest& test) {
  joint.accepted[name].shape.back() = static_cast<double>(form);
  joint.accepted[name].value = test.value;
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

}  // namespace

void take_simpler_forms(JointModel& joint, Selected& selected, const Vehicle& nominal) {
  constexpr double kPlainly = 4.0;   // of twice the log-likelihood: two standard errors
  constexpr double kOfForms = 0.05;  // of an amplitude, by which no form is the world's
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const AcceptedEffect& a = joint.accepted[k];
    const bool has_simpler = !a.effect->simpler_form.empty();
    const bool may_move_the_point = a.effect->forms.size() > 1 && a.shape.size() == 1 && !a.is_held;
    if (!has_simpler && (!may_move_the_point || sits_as_given(joint, nominal))) continue;
    const auto own = static_cast<std::size_t>(a.shape.back());
    const std::size_t simpler = has_simpler ? static_cast<std::size_t>(a.effect->simpler_form[own]) : 0;
    if (simpler == own) continue;
    const CandidateTest test = tested_in_form(joint, k, simpler);
    std::vector<double> shape = a.shape;
    shape.back() = static_cast<double>(simpler);
    const double as_it_is = tested_in_form(joint, k, own).statistic;
    const double plainly =
        std::max(kPlainly * selected.evidence[k].test.inflation, has_simpler ? 0.0 : kOfForms * kOfForms * as_it_is);
    if (test.statistic < as_it_is - plainly || !is_physical(joint, *a.effect, test.value, shape)) continue;
    JointModel instead = in_form(joint, k, simpler, test);
    if (!has_simpler && !sits_as_given(instead, nominal)) continue;
    joint = std::move(instead);
    selected.evidence[k].test.shape = joint.accepted[k].shape;
  }
}

}  // namespace odolab
