// What recordings cannot determine of a drive, and which drive would, in sentences.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Share of its prior that a determined parameter's standard error stays below.
constexpr double kDetermined = 0.1;

// `determined`: of each column. `scale_is_open`: of radii and wheelbase only ratios show, and the mean
// radius is as it was given.
std::vector<std::string> what_cannot_be_told(const std::vector<char>& determined, bool scale_is_open,
                                             const std::vector<int>& active, const std::vector<InnovationRun>& runs,
                                             const DifferentialDrive& drive, bool any_heading);

}  // namespace odolab
