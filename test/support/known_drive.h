// A calibration held against the drive that its recordings were made with.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <variant>

#include "core/calibration/least_squares.h"

namespace odolab::test {

// Radii and wheelbase: determined, and true within four of their standard errors, which three parameters are by chance
// 9998 times in 10 000.
inline void expect_holds(const LeastSquaresCalibration& fit, const DifferentialDrive& actual) {
  const std::pair<const char*, double> sizes[] = {{"wheelbase_m", actual.wheelbase_m},
                                                  {"wheel_radius_left_m", actual.wheel_radius_left_m},
                                                  {"wheel_radius_right_m", actual.wheel_radius_right_m}};
  for (const ParameterEstimate& p : fit.parameters)
    for (const auto& [name, true_m] : sizes) {
      if (p.name != name) continue;
      EXPECT_TRUE(p.determined) << name;
      EXPECT_LT(std::abs(p.value - true_m), 4.0 * p.stderr_value) << name;
    }
}

}  // namespace odolab::test
