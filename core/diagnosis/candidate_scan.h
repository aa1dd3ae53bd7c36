// The same test as JointModel::test for very many candidates, one after another: README.md in this folder, Eq. 15.
#pragma once

#include <vector>

#include "core/diagnosis/joint_model.h"

namespace odolab {

// Holds on to the model, which must stay as it is.
class CandidateScan {
 public:
  // `without`: an accepted effect that is taken out for the question.
  explicit CandidateScan(const JointModel& joint, int without = -1);
  // Without inflation and cross-validation. An event costs no more than it lasts.
  CandidateTest test(const Effect& effect, const std::vector<double>& shape) const;

 private:
  struct OfRun {
    LinearisedRun::Tails tails;
    std::vector<int> columns;        // of the model, those that act in this run
    std::vector<double> per_motion;  // for each wheel interval and forward, sideways, turn: by each of these columns,
                                     // and last by what is left
  };
  const JointModel& joint_;
  int without_;
  JointModel::Absorbing absorbing_;
  std::vector<OfRun> of_run_;
};

}  // namespace odolab
