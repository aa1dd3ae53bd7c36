// The point that a map leaves as it is, where the map by itself converges slowly.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace odolab {

// By what the last steps had in common (Anderson 1965, "Iterative procedures for nonlinear integral equations").
class FixedPoint {
 public:
  // Where to ask the map next, after it led from `at` to `to`.
  Eigen::VectorXd next(const Eigen::VectorXd& at, const Eigen::VectorXd& to);

 private:
  struct Change {
    Eigen::VectorXd of_to, of_step;
  };
  std::vector<Change> changes_;
  Eigen::VectorXd last_to_, last_step_;
};

}  // namespace odolab
