// What recordings cannot determine of a drive, and which drive would, in sentences.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Share of its prior that a determined parameter's standard error stays below.
constexpr double kDetermined = 0.1;

// `determined`: of each column. `information`: of the columns in `active`, in units of their priors.
std::vector<std::string> what_cannot_be_told(const std::vector<char>& determined, const std::vector<int>& active,
                                             const Eigen::MatrixXd& information, const std::vector<InnovationRun>& runs,
                                             const DifferentialDrive& drive, bool any_heading);

}  // namespace odolab
