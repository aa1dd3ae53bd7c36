// What a diagnosis says of the lengths that it calibrated, beside what they are.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/diagnosis/diagnosis.h"

namespace odolab::test {

// Within 3.5 standard errors, which are smaller than a share of it.
inline void expect_known(const Diagnosis& d, const std::string& name, double actual, double at_least_to) {
  const auto& all = d.calibration.parameters;
  const auto p = std::find_if(all.begin(), all.end(), [&](const ParameterEstimate& e) { return e.name == name; });
  ASSERT_NE(p, all.end()) << name;
  EXPECT_NEAR(p->value, actual, 3.5 * p->stderr_value) << name;
  EXPECT_LT(p->stderr_value, at_least_to * actual) << name;
}

}  // namespace odolab::test
