#include "core/diagnosis/chosen_by_unseen.h"

#include <optional>

#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/shape_search.h"

namespace odolab {

namespace {

JointModel with_instead(JointModel joint, std::size_t name, const ScoredCandidate& other) {
  joint.accepted[name] = {other.effect, other.test.shape, std::vector<double>(other.test.value.size(), 0.0)};
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

// Another form of the same name, where it fits as well and predicts better.
void choose_form(const Predictor& predictor, JointModel& joint, std::size_t name) {
  const Effect& effect = *joint.accepted[name].effect;
  if (effect.forms.size() < 2 || joint.accepted[name].is_held || joint.distrust() > 0.0) return;
  const std::vector<double> shape = joint.accepted[name].shape;
  const double own = tested_in_form(joint, name, static_cast<std::size_t>(shape.back())).statistic;
  std::optional<Predicted> best;  // asked where there is another form
  const JointModel fitted = joint;
  for (std::size_t form = 0; form < effect.forms.size(); ++form) {
    ScoredCandidate other;
    other.effect = &effect;
    other.test.shape = shape;
    other.test.shape.back() = static_cast<double>(form);
    if (other.test.shape == shape) continue;
    const CandidateTest test = tested_in_form(joint, name, form);
    const bool is_tested = test.value.size() == joint.accepted[name].value.size();  // else calibration leaves nothing
    if (!is_tested || test.statistic < own - kClearlyBeaten ||
        !is_physical(joint, effect, test.value, other.test.shape))
      continue;
    other.test.value = test.value;
    JointModel model = with_instead(fitted, name, other);
    if (!best) best = predictor.of(fitted, fitted.model.noise);
    Predicted by_other = predictor.of(model, fitted.model.noise);
    if (!by_other.unseen || !best->unseen || likelier_where_unseen(by_other, *best) < kClearlyBeaten) continue;
    joint = std::move(model);
    best = std::move(by_other);
  }
}

}  // namespace

void choose_by_unseen(const Predictor& predictor, JointModel& joint, Selected& selected) {
  if (predictor.leaves_out_in_turn()) return;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) choose_form(predictor, joint, k);
  std::optional<Predicted> by_joint;  // asked once for each model
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    for (std::vector<ScoredCandidate>* others : {&selected.coming_back[k], &selected.alternatives[k]})
      for (std::size_t n = 0; n < others->size();) {
        JointModel other = with_instead(joint, k, (*others)[n]);
        if (!by_joint) by_joint = predictor.of(joint, joint.model.noise);
        const Predicted by_other = predictor.of(other, joint.model.noise);
        if (!by_other.unseen || !by_joint->unseen) return;
        const bool is_better = worse_than_chance(by_other.unseen->error, by_joint->unseen->error) > 0.0;
        const bool is_worse = worse_than_chance(by_joint->unseen->error, by_other.unseen->error) > 0.0;
        if (!is_better && !is_worse) {
          ++n;
          continue;
        }
        if (is_better) {
          joint = std::move(other);
          by_joint.reset();
          selected.evidence[k] = (*others)[n];
        }
        others->erase(others->begin() + static_cast<std::ptrdiff_t>(n));
      }
  }
}

}  // namespace odolab
