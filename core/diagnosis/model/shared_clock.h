// How late the truth is in recordings that each have a clock of their own.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace odolab {

// Their mean, in which a recording counts as much as it knows of its clock, and no more than the clocks differ from
// each other: a random-effects mean (DerSimonian and Laird 1986, "Meta-analysis in clinical trials").
struct SharedClock {
  double offset_s = 0.0, stderr_s = 0.0;
  double between_s = 0.0;   // by how much the clocks themselves differ: a standard deviation
  Eigen::VectorXd weights;  // of the recordings; their sum is one
};

// `covariance`: of these clocks. Where it is none, as of a model without columns, all count alike.
SharedClock shared_clock(const std::vector<double>& clock_s, const Eigen::MatrixXd& covariance);

}  // namespace odolab
