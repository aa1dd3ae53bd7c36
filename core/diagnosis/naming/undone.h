// What happens at one moment and is undone soon after is no push: a truth that was somewhere else for a while.
#pragma once

#include <optional>

#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

struct Undone {
  int run = 0;
  double from_s = 0.0, to_s = 0.0;        // on the wheels' clock
  double away_m = 0.0, turned_rad = 0.0;  // how far off the truth was meanwhile
};

// Unset where a step that stays says as much.
std::optional<Undone> undone(const JointModel& joint, const ScoredCandidate& at_one_moment);

// The catalogue's entry of a push from outside, which is what stays where something is not undone.
const Effect& push_from_outside();

// A truth that is somewhere else about a moment of a run, for 0.1 to 1.5 s: where that says most; its shape is the run,
// and from when to when on the wheels' clock.
CandidateTest away_for_a_while(const CandidateScan& scan, int run, double at_s);
// By how much of its statistic chance makes it say more than a step that stays, since it is looked for in many ways.
double away_by_chance();

}  // namespace odolab
