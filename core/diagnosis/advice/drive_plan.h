// Which drives decide what is still open: core/diagnosis/README.md, Eq. 14.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "core/diagnosis/advice/advised_drive.h"

namespace odolab {

// What is to be decided: whether the columns [from, from + value.size()) have that value, whatever those of `free` are.
struct Decision {
  int from = 0;
  Eigen::VectorXd value;
  std::vector<int> free;
  double inflation = 1.0, needed = 5.0;
};

// How far apart they are with that information on all columns, in standard deviations.
double separation(const Eigen::MatrixXd& information, const Decision& d);

struct DrivePlan {
  std::vector<int> times;  // of each manoeuvre
  double duration_s = 0.0;
  std::vector<double> reached;  // the separation for each decision
  bool any = false;
};

// Greedy: at each step the manoeuvre that closes most of what is open, for its time. `adds`: the information that each
// of `all` would bring.
DrivePlan planned(const Eigen::MatrixXd& known, const std::vector<Eigen::MatrixXd>& adds,
                  const std::vector<AdvisedDrive>& all, const std::vector<Decision>& decisions);

std::string in_words(const DrivePlan& plan, const std::vector<AdvisedDrive>& all);
std::vector<DriveLeg> legs_of(const DrivePlan& plan, const std::vector<AdvisedDrive>& all);

}  // namespace odolab
