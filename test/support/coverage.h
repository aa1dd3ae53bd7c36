// How often stated intervals hold the truth, over many cases.
#pragma once

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/diagnosis.h"

namespace odolab::test {

struct Coverage {
  int cases = 0, held = 0;
  double sum_z = 0.0, sum_z2 = 0.0, sum_error = 0.0, sum_stderr = 0.0;

  void add(double value, double stderr_value, double truth, bool is_angle) {
    const double error = is_angle ? std::remainder(value - truth, 2.0 * kPi) : value - truth, z = error / stderr_value;
    ++cases;
    held += std::abs(z) <= 1.96;
    sum_z += z, sum_z2 += z * z, sum_error += error, sum_stderr += stderr_value;
  }
  double share() const { return cases > 0 ? static_cast<double>(held) / cases : 0.0; }
};

using CoverageTable = std::map<std::string, Coverage>;

// Adds the parameters of the finding with that name, if it is there; the calibration in any case.
inline bool add_to(CoverageTable& table, const Diagnosis& d, const std::string& effect,
                   const std::vector<std::pair<std::string, double>>& truth, const DifferentialDrive& actual) {
  const Finding* found = nullptr;
  for (const Finding& f : d.findings)
    if (!found && f.effect == effect) found = &f;
  if (!found && !effect.empty()) return false;
  if (found)
    for (const auto& [name, true_value] : truth)
      for (const FoundParameter& p : found->parameters)
        if (p.name == name)
          table[effect + "." + name].add(p.value, p.stderr_value, true_value,
                                         name == "direction_rad" || name == "phase_rad");
  const std::pair<const char*, double> sizes[3] = {{"wheel_radius_left_m", actual.wheel_radius_left_m},
                                                   {"wheel_radius_right_m", actual.wheel_radius_right_m},
                                                   {"wheelbase_m", actual.wheelbase_m}};
  for (const auto& [name, true_value] : sizes)
    for (const ParameterEstimate& p : d.calibration.parameters)
      if (p.name == name && p.determined)
        table[(effect.empty() ? "nothing" : effect) + ": " + name].add(p.value, p.stderr_value, true_value, false);
  return true;
}

inline void print(const CoverageTable& table) {
  for (const auto& [name, c] : table)
    std::printf("%-52s %4d cases %5.1f %%  mean z %+5.2f rms z %5.2f  mean error %+.3g  mean stderr %.3g\n",
                name.c_str(), c.cases, 100.0 * c.share(), c.sum_z / c.cases, std::sqrt(c.sum_z2 / c.cases),
                c.sum_error / c.cases, c.sum_stderr / c.cases);
}

}  // namespace odolab::test
