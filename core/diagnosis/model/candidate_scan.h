// The same test as JointModel::test for very many candidates, one after another: core/diagnosis/README.md, Eq. 15.
#pragma once

#include <memory>
#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Holds on to the model, which must stay as it is. What was asked of it once is remembered for all scans of the same
// linearisation, whatever effect is taken out.
class CandidateScan {
 public:
  // `without`: an accepted effect that is taken out for the question.
  explicit CandidateScan(const JointModel& joint, int without = -1);
  // Without inflation and cross-validation. An event costs no more than it lasts. May be asked by several threads.
  CandidateTest test(const Effect& effect, const std::vector<double>& shape) const;
  // The same of many shapes, sooner than one by one; what else is asked changes no more than the rounding.
  std::vector<CandidateTest> tests(const Effect& effect, const std::vector<std::vector<double>>& shapes) const;

  const JointModel& joint() const { return joint_; }

 private:
  const JointModel& joint_;
  int without_;
  JointModel::Absorbing absorbing_;
  std::shared_ptr<ScannedProducts> products_;
};

}  // namespace odolab
