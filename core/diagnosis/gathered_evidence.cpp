#include "core/diagnosis/gathered_evidence.h"

#include <algorithm>
#include <cmath>

namespace odolab {

GatheredEvidence gathered_evidence(const std::vector<std::vector<SampleEvidence>>& of_run,
                                   const std::vector<std::string>& names, double gain) {
  constexpr double k95 = 1.96;
  double squares = 0.0;
  for (const std::vector<SampleEvidence>& run : of_run)
    for (const SampleEvidence& s : run) squares += s.square;
  GatheredEvidence g;
  if (!(squares > 0.0) || !(gain > 0.0)) return g;
  const double scale = gain / (0.5 * squares), all = 2.0 * gain;
  double before_s = 0.0, product = 0.0, information = 0.0;
  for (std::size_t r = 0; r < of_run.size(); ++r) {
    if (of_run[r].empty()) continue;
    g.begins.emplace_back(names[r], before_s);
    const double first_s = of_run[r].front().time_s;
    for (const SampleEvidence& s : of_run[r]) {
      product += scale * s.product;
      information += scale * s.square;
      const double either_side = k95 * std::sqrt(std::max(0.0, information * (1.0 - information / all)));
      g.driven_s.push_back(before_s + s.time_s - first_s);
      g.gain.push_back(product + 0.5 * information);
      g.foreseen.push_back(0.5 * information);
      g.low.push_back(0.5 * information - either_side);
      g.high.push_back(0.5 * information + either_side);
    }
    before_s = g.driven_s.back();
  }
  return g;
}

GatheredEvidence gathered_evidence(const JointModel& joint, std::size_t accepted_effect, double gain) {
  const AcceptedEffect& accepted = joint.accepted[accepted_effect];
  if (!accepted.acts_on_motion() || accepted.is_held) return {};
  std::vector<std::string> names;
  for (const InnovationRun& run : joint.runs()) names.push_back(run.name);
  return gathered_evidence(joint.evidence_of(static_cast<int>(accepted_effect)), names, gain);
}

}  // namespace odolab
