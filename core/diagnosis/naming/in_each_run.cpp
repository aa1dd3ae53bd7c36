#include "core/diagnosis/naming/in_each_run.h"

#include <algorithm>

namespace odolab {

GainOfEach gain_of_each(const std::vector<std::vector<SampleEvidence>>& of_run, double inflation) {
  constexpr double kKnown = 9.0;  // three standard errors, squared
  std::vector<double> score, information;
  double all_score = 0.0, all_information = 0.0;
  for (const std::vector<SampleEvidence>& run : of_run) {
    double s = 0.0, e = 0.0;
    for (const SampleEvidence& sample : run) {
      s += (sample.product + sample.square) / inflation;
      e += sample.square / inflation;
    }
    score.push_back(s);
    information.push_back(e);
    all_score += s;
    all_information += e;
  }
  GainOfEach all;
  for (std::size_t r = 0; r < of_run.size(); ++r) {
    const double others = all_information - information[r];
    if (others < kKnown) continue;
    const double size = (all_score - score[r]) / others;
    all.gain += size * score[r] - 0.5 * size * size * information[r];
    all.foreseen += 0.5 * information[r] * (1.0 - 1.0 / others);
  }
  return all;
}

bool comes_back(const GainOfEach& all) {
  constexpr double kAgreed = 0.6;
  constexpr double kFewest = 3.0, kEnough = 6.0;  // foreseen, to be judged at all, and by a share of it
  return all.foreseen <= kFewest || all.gain >= (all.foreseen > kEnough ? kAgreed * all.foreseen : 0.0);
}

bool comes_back(const JointModel& joint, std::size_t accepted_effect, double inflation) {
  const AcceptedEffect& a = joint.accepted[accepted_effect];
  if (!a.acts_on_motion() || a.is_held || a.effect->of_one_recording || a.effect->of_each_recording) return true;
  return comes_back(gain_of_each(joint.evidence_of(static_cast<int>(accepted_effect)), std::max(1.0, inflation)));
}

}  // namespace odolab
