#include "core/diagnosis/naming/late_wheel.h"

#include <cmath>

#include "core/base/formatted.h"
#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

Effect older_counts() {
  Effect e;
  e.name = "older_counts";
  e.component = "right_wheel";
  e.amplitudes = {{"older_s", "s"}};
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    return motions_by_number(of_older_counts(view));
  };
  return e;
}

bool is_of_a_wheel_that_speeds_up(const Effect& e) {
  return (e.name == "traction_slip" || e.name == "drivetrain_backlash") && e.component != component_of(Wheel::both);
}

}  // namespace

Motions of_older_counts(const DriveView& view) {
  Motions m(view.steps.size());
  for (std::size_t i = 0; i < view.steps.size(); ++i)
    m[i] = by_wheel(Wheel::right, view.steps[i].right_mps2 * view.steps[i].duration_s, view.drive.wheelbase_m);
  return m;
}

std::optional<double> older_instead(const JointModel& joint, std::size_t k, const ScoredCandidate& evidence) {
  static const Effect older = older_counts();
  if (!is_of_a_wheel_that_speeds_up(*joint.accepted[k].effect)) return std::nullopt;
  const CandidateTest test = CandidateScan(joint, static_cast<int>(k)).test(older, {});
  const bool says_as_much = test.statistic > evidence.test.statistic - kClearlyBeaten;
  if (!says_as_much || test.value.empty() || std::abs(test.value[0]) > kLoopTakes_s) return std::nullopt;
  return test.value[0];
}

std::string in_words(const OlderCounts& older) {
  std::string names;
  for (const std::string& name : older.instead_of) names += (names.empty() ? "" : " or ") + name;
  return formatted(
             "the right wheel's counts seem to be %.2g ms %s than the left one's, as where a loop asks one counter "
             "after the other; ",
             1e3 * std::abs(older.right_older_s), older.right_older_s > 0.0 ? "older" : "newer") +
         names + " would describe no more";
}

}  // namespace odolab
