// Least value of a function whose slope is known and whose curvature is known about: Newton's steps, within a region of
// trust (K. Levenberg 1944), with the curvature corrected by how the slope changed over short ones before (BFGS), made
// shorter where they promise too much (L. Armijo 1966).
#pragma once

#include <functional>
#include <vector>

namespace odolab {

struct Sloped {
  double value = 0.0;
  std::vector<double> slope;
  std::vector<double> curvature;  // row by row, positive definite: exact, or as expected (Fisher, Gauss-Newton)
};

struct DescentLimits {
  double longest_step = 1.5;  // of any variable
  double least_gain = 0.01;   // ends where a step promises less
  int most_calls = 60;
};

// `function` may put what it is asked for right, into its bounds, and is then taken there; a variable that is to stay
// where it is has a slope of nothing. Returns the best place that was seen. The last step, which promises less than the
// least gain, is taken without asking.
std::vector<double> descended(const std::function<Sloped(std::vector<double>& at)>& function, std::vector<double> start,
                              const DescentLimits& limits = {});

}  // namespace odolab
