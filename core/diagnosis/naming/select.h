// Which effects of the catalogue are missing: forward with refit, swapped, backward, with what is not clearly beaten
// kept beside each.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/naming/scored_candidates.h"
#include "core/diagnosis/naming/undone.h"

namespace odolab {

struct Selected {
  std::vector<ScoredCandidate> evidence;                   // of each accepted effect of the model, in its order
  std::vector<std::vector<ScoredCandidate>> alternatives;  // not clearly beaten
  // Of what happened once: what says less, but comes back, so that recordings it was not fitted to may decide.
  std::vector<std::vector<ScoredCandidate>> coming_back;
  std::vector<ScoredCandidate> first_look;  // all candidates before any was let in
  std::vector<ScoredCandidate> beside_all;  // and beside all that stayed; empty where none did
  // What was about to be let in as happening at one moment, and is undone soon after: then nothing else is filled in.
  std::optional<Undone> undone;
};
// `refuted`: names that are not to be let in. `asks_what_is_undone`: ends at the first moment that is
// (Selected::undone).
Selected select_effects(JointModel& joint, double family_wise_error, const Progress& progress,
                        const std::vector<const Effect*>& refuted = {}, bool asks_what_is_undone = false);

// Of twice the log-likelihood, noise and all: beyond what rounded readings and a changed wheelbase make of it.
constexpr double kDecisive = 200.0;

// Of twice the log-likelihood: names that are nearer to each other are not told apart.
constexpr double kClearlyBeaten = 10.0;

// What of an effect's evidence other names must have a share of. A smoothed truth tells by every sample, and what it
// does beyond its second moment looks like nothing that a vehicle does. A clock's rate is the same all along, and
// nothing that a vehicle does follows the moments alone: however far it is off, it leaves no larger trace.
inline double counted(const Effect& effect, double statistic) {
  constexpr double kOfTheTruth = 0.3;
  if (effect.clock_rate) return std::min(statistic, kDecisive);
  return effect.of_the_truth ? kOfTheTruth * statistic : statistic;
}

// The same for what has no name: kernels differ, so that it is held against all that a smoothed truth says.
inline double counted_for_the_unnamed(const Effect& effect, double statistic) {
  return effect.clock_rate ? counted(effect, statistic) : statistic;
}

}  // namespace odolab
