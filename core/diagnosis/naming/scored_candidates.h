// Every entry of the catalogue at the shape that fits best, judged against a model that does not hold it.
#pragma once

#include <vector>

#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

struct ScoredCandidate {
  const Effect* effect = nullptr;
  CandidateTest test;
  double p_value = 1.0;       // family-wise
  double log_tests = 0.0;     // logarithm of how many it was chosen from
  bool beyond_counts = true;  // more than whole counts can feign
};

// Best first. `without`: an accepted effect that is taken out for the question; what at the points of its scan says
// less than a fifth of that one is not looked for more closely.
std::vector<ScoredCandidate> scored_candidates(const JointModel& joint, int without = -1);

// How one entry is looked for.
struct Sought {
  int without = -1;                            // an accepted effect that is taken out for the question
  int tests = 1;                               // that it is one of
  std::vector<std::vector<double>> also_from = {};  // see best_shape
  double worth_refining = 0.0;
};

// The best shape of one entry; `scan` is of the same question.
ScoredCandidate scored_candidate(const JointModel& joint, const CandidateScan& scan, const Effect& effect,
                                 const Sought& sought);

// Places and times were found under the noise that they made themselves: each is sought once more beside the others,
// and all is fitted anew where another says more. So is the form of what goes by its own size: by which it went best
// while that was open says little.
void find_places_again(JointModel& joint);

// Its p value, from its test.
void judge(ScoredCandidate& candidate);

// The same cause in each recording on its own.
bool is_finer(const Effect& own, const Effect& shared);

}  // namespace odolab
