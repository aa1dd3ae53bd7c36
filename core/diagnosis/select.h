// Which effects of the catalogue are missing: forward with refit, swapped, backward, with what is not clearly beaten
// kept beside each.
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/joint_model.h"

namespace odolab {

struct ScoredCandidate {
  const Effect* effect = nullptr;
  CandidateTest test;
  double p_value = 1.0;       // family-wise
  double log_tests = 0.0;     // logarithm of how many it was chosen from
  bool beyond_counts = true;  // more than whole counts can feign
};

// Every entry's best shape, judged against the model as it is; best first.
std::vector<ScoredCandidate> scored_candidates(const JointModel& joint, double family_wise_error, int without = -1);

struct Selected {
  std::vector<ScoredCandidate> evidence;                   // of each accepted effect of the model, in its order
  std::vector<std::vector<ScoredCandidate>> alternatives;  // not clearly beaten
  std::vector<ScoredCandidate> first_look;                 // all candidates before any was let in
};
Selected select_effects(JointModel& joint, double family_wise_error, const Progress& progress);

// Whether dead reckoning is better already than any floor or camera resolves, 0.02 mm and 0.02 mrad.
bool is_nothing(const JointModel::GatheredError& error);

// Share of the squared error of dead reckoning that a term may leave to be believed. Where the innovations are
// correlated the truth's noise is not what the likelihood takes it for, and small gains of likelihood mean little; less
// where the truth was smoothed, since its own turns are then late. Where they are white the likelihood is believed:
// what dead reckoning gains by a weak effect is lost in what it gains and loses by chance.
double most_left(const JointModel& joint, bool local = false, std::size_t numbers = 1);
constexpr double kMaterial = 0.985;  // for each number that is fitted
bool is_material(const JointModel::GatheredError& before, const JointModel::GatheredError& after, double most_left);

// Of twice the log-likelihood, noise and all: beyond what rounded readings and a changed wheelbase make of it.
constexpr double kDecisive = 200.0;

// A log-likelihood ratio below which two names are not told apart.
constexpr double kClearlyBeaten = 5.0;

}  // namespace odolab
