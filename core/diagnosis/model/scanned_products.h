// Products of very many candidates' columns with each other, with the model's and with what is left, in one
// linearisation: core/diagnosis/README.md, Eq. 15.
#pragma once

#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

class ScannedProducts {
 public:
  struct OfShape {
    CandidateProducts products;
    bool acts = false;  // in some run
  };

  // Of a model as it was linearised, which must live on.
  ScannedProducts(const std::vector<DriveView>& views, const std::vector<LinearisedRun>& runs,
                  const std::vector<std::vector<int>>& columns, const std::vector<Eigen::MatrixXd>& z,
                  const std::vector<Eigen::VectorXd>& residual, int model_columns);

  // In the order of the shapes; those that were asked before are remembered. What else is asked changes no more than
  // the rounding. May be asked by several threads; of one effect by one after another, or one shape at a time.
  std::vector<OfShape> of(const Effect& effect, const std::vector<const std::vector<double>*>& shapes);

 private:
  struct OfRun {
    LinearisedRun::Tails tails;
    std::size_t wide = 0;         // columns of the model that act in this run, what is left behind them, and up to a
                                  // whole number of blocks
    std::vector<double> by_move;  // for what moves in each truth interval, x, y and heading: by each of these
  };
  // What is used over and over.
  struct Scratch {
    std::vector<std::vector<Motions>> motions;
    LinearisedRun::Moved moved;
    std::vector<double> products, with;
  };
  // Of up to LinearisedRun::kAbreast shapes.
  void work_out(const Effect& effect, const std::vector<double>* const* shapes, std::size_t count,
                OfShape* const* results, Scratch& scratch) const;
  // The products of what moves with each of `wide` columns: by column of `moved`, then by candidate.
  template <int abreast>
  static void products_with(const OfRun& of, const LinearisedRun::Moved& moved, std::vector<double>& with);

  const std::vector<DriveView>& views_;
  const std::vector<LinearisedRun>& runs_;
  const std::vector<std::vector<int>>& columns_;
  int model_columns_;
  std::vector<OfRun> of_run_;
  std::mutex one_at_a_time_;
  std::map<std::pair<const Effect*, std::vector<double>>, OfShape> known_;
};

}  // namespace odolab
