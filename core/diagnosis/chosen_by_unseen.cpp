#include "core/diagnosis/chosen_by_unseen.h"

#include <optional>

#include "core/diagnosis/naming/material.h"

namespace odolab {

namespace {

JointModel with_instead(JointModel joint, std::size_t name, const ScoredCandidate& other) {
  joint.accepted[name] = {other.effect, other.test.shape, std::vector<double>(other.test.value.size(), 0.0), {}};
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

}  // namespace

void choose_by_unseen(const Predictor& predictor, JointModel& joint, Selected& selected) {
  if (predictor.leaves_out_in_turn()) return;
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
