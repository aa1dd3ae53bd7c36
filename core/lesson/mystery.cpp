#include "core/lesson/mystery.h"

namespace odolab {

MysteryOutcome judged(const Mystery& mystery, const Diagnosis& diagnosis) {
  MysteryOutcome outcome;
  outcome.findings = static_cast<int>(diagnosis.findings.size());
  for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
    const Finding& f = diagnosis.findings[i];
    if (f.effect != mystery.effect || f.component != mystery.component) continue;
    outcome.named = true;
    outcome.named_first = outcome.named_first || i == 0;
  }
  return outcome;
}

}  // namespace odolab
