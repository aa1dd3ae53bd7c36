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
  // The same of many shapes, sooner than one by one; the results do not depend on what else is asked.
  std::vector<CandidateTest> tests(const Effect& effect, const std::vector<std::vector<double>>& shapes) const;

 private:
  struct OfRun {
    LinearisedRun::Tails tails;
    std::vector<int> columns;     // of the model, those that act in this run
    std::size_t wide = 0;         // so many, with what is left behind them, and up to a whole number of blocks
    std::vector<double> by_move;  // for what moves in each truth interval, x, y and heading: by each of these
  };
  // What is used over and over.
  struct Scratch {
    std::vector<std::vector<Motions>> motions;
    LinearisedRun::Moved moved;
    std::vector<double> products, with;
  };
  // Of up to LinearisedRun::kAbreast shapes.
  void test_abreast(const Effect& effect, const std::vector<double>* const* shapes, std::size_t count,
                    CandidateTest* results, Scratch& scratch) const;
  // The products of what moves with each of `wide` columns: by column of `moved`, then by candidate.
  template <int abreast>
  static void products_with(const OfRun& of, const LinearisedRun::Moved& moved, std::vector<double>& with);

  const JointModel& joint_;
  int without_;
  JointModel::Absorbing absorbing_;
  std::vector<OfRun> of_run_;
};

}  // namespace odolab
