// Where joints say that an axle is, against where its wheels do.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

// One stretch of an axle's way by its wheels, laid on the same stretch by the joints: turned and moved until they
// differ by nothing in the mean.
struct LaidStretch {
  Pose joints_T_wheels;               // the wheels' own frame in that of the joints
  std::vector<Eigen::Vector3d> rest;  // Eq. 1 of README.md: joints less wheels, along and across the unit, in heading
};

// As many poses of both, one at least.
LaidStretch laid_stretch(const std::vector<Pose>& by_joints, const std::vector<Pose>& by_wheels);

}  // namespace odolab
