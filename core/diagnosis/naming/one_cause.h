// When two names are of one and the same thing in the world.
#pragma once

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Two effects that are confounded with each other.
bool looks_like(const Effect& a, const Effect& b);

// Play of both wheels, and of one of them: a wheel has but one.
bool is_within(const Effect& one_wheel, const Effect& both_wheels);

bool of_one_moment(const ScoredCandidate& a, const ScoredCandidate& b);

// A bump that is met each time, and a patch about it that is no wider than a bump may be.
bool of_one_small_place(const ScoredCandidate& bump, const ScoredCandidate& patch);

// What is left of something that was already let in belongs to its shape.
bool of_the_same(const JointModel& joint, const ScoredCandidate& candidate);

// Whether another effect that acts but here and there acts where this one does, and half as strongly: no castor kicks
// twice alike.
bool happens_within_another(const JointModel& joint, const Effect& event, const CandidateTest& test);

// Pushes and bumps, each at its own moment, that were let in. So many are no mishap: something happens time and again.
int happened_once(const JointModel& joint);
inline constexpr int kTimeAndAgain = 3;

}  // namespace odolab
