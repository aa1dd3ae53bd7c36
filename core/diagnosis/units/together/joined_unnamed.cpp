#include "core/diagnosis/units/together/joined_unnamed.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/findings_of.h"
#include "core/diagnosis/gathered_evidence.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/truth_errors.h"
#include "core/diagnosis/units/together/joined_groups.h"

namespace odolab {

namespace {

constexpr double kUnnamedInstead = 1.15;

// Says of a finding that it has no name, and what it goes with.
void put_words(Finding& unknown, const std::string& goes_with) {
  unknown.effect = "unknown";
  unknown.where.regime = goes_with;
  unknown.sentence = "something that no entry of the catalogue describes: " + goes_with;
}

Alternative as_alternative(const ScoredTogether& named) {
  return {named.candidate.effect->name, named.candidate.component, 0.5 * named.test.judged(), ""};
}

std::optional<Finding> strongest_of(const std::vector<JoinedGroup>& groups, const JoinedModel& model,
                                    const std::vector<ScoredTogether>& names, double family_wise_error) {
  JoinedModel with = model;
  double named = 0.0;
  for (const ScoredTogether& s : names) {
    with.let_in(*s.columns);
    named += s.test.judged();
  }
  const double least = std::max(kLeastOfJoinedBodies, least_said(model.vehicle()));
  const auto tests = static_cast<double>(groups.size());
  std::vector<Finding> found(groups.size());
  std::vector<double> excess(groups.size(), 0.0);
  parallel_for(static_cast<int>(groups.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const JoinedColumns columns = groups[k].columns(model);
    const JoinedTest beside = with.test(columns), instead = names.empty() ? beside : model.test(columns);
    const double p = beside.freedom > 0 ? chi_square_tail(beside.judged(), beside.freedom) * tests : 1.0;
    if (p >= 0.1 * family_wise_error) return;
    const bool more_beside = beside.judged() > least + 2.0 * beside.freedom &&
                             beside.judged() - beside.freedom > kMostLeft * named && beside.lasts_throughout();
    const bool more_instead =
        !names.empty() && instead.judged() - 2.0 * instead.freedom - 2.0 * std::log(tests) > kUnnamedInstead * named;
    if (!more_beside && !more_instead) return;
    if (groups[k].is_more_than_rounding) {
      const Eigen::VectorXd& value = beside.value;
      if (!groups[k].is_more_than_rounding(std::vector<double>(value.begin(), value.end()))) return;
    }
    Finding& f = found[k];
    put_words(f, groups[k].words);
    f.component = groups[k].component;
    f.log_likelihood_gain = 0.5 * (names.empty() ? beside.judged() : std::max(beside.judged(), instead.judged()));
    f.p_value = std::min(1.0, p);
    excess[k] = f.log_likelihood_gain - 0.5 * beside.freedom;
  });
  const auto most = std::max_element(excess.begin(), excess.end());
  if (most == excess.end() || *most <= 0.0) return std::nullopt;
  const auto best = static_cast<std::size_t>(most - excess.begin());
  Finding unknown = found[best];
  const JoinedColumns columns = groups[best].columns(model);
  unknown.gathered = gathered_evidence(with.evidence_of(columns, with.test(columns).value), model.names(),
                                       unknown.log_likelihood_gain);
  for (const ScoredTogether& s : names) unknown.alternatives.push_back(as_alternative(s));
  leave_out_what_it_hardly_resembles(unknown);
  return unknown;
}

// Who pushes a vehicle twice has another cause, which comes and goes.
std::optional<Finding> pushed_again_and_again(const std::vector<ScoredTogether>& names) {
  Finding unknown;
  int pushes = 0;
  for (const ScoredTogether& s : names) {
    unknown.log_likelihood_gain += 0.5 * s.test.judged();
    unknown.p_value = std::min(unknown.p_value, s.p_value);
    unknown.alternatives.push_back(as_alternative(s));
    if (s.candidate.effect->name == "collision" && ++pushes == 1) unknown.component = s.candidate.component;
  }
  if (pushes < 2) return std::nullopt;
  put_words(unknown, "at moments of their own, as by pushes that no one gave");
  return unknown;
}

}  // namespace

std::optional<Finding> unnamed_together(const JoinedModel& model, const std::vector<ScoredTogether>& named,
                                        double family_wise_error) {
  std::optional<Finding> unknown = strongest_of(joined_groups(model), model, named, family_wise_error);
  return unknown ? unknown : pushed_again_and_again(named);
}

std::optional<Finding> unnamed_joint(const JoinedModel& model, double family_wise_error) {
  return strongest_of(groups_of_joints(model), model, {}, family_wise_error);
}

}  // namespace odolab
