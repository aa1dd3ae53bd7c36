// Least value of a function of a few variables without derivatives: J. A. Nelder, R. Mead 1965.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace odolab {

// Starts from a simplex of the given stride about `start`; ends where the values at its corners differ by less than
// `tolerance`, or after `most_calls`.
inline std::vector<double> minimised(const std::function<double(const std::vector<double>&)>& value,
                                     std::vector<double> start, double stride, double tolerance, int most_calls) {
  struct Corner {
    std::vector<double> at;
    double value;
  };
  const std::size_t n = start.size();
  int calls = 0;
  const auto corner_at = [&](std::vector<double> at) {
    ++calls;
    const double v = value(at);
    return Corner{std::move(at), v};
  };
  std::vector<Corner> simplex = {corner_at(start)};
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> at = start;
    at[k] += stride;
    simplex.push_back(corner_at(std::move(at)));
  }
  const auto sort = [&] {
    std::sort(simplex.begin(), simplex.end(), [](const Corner& a, const Corner& b) { return a.value < b.value; });
  };
  for (sort(); calls < most_calls && simplex.back().value - simplex.front().value > tolerance; sort()) {
    std::vector<double> centre(n, 0.0);
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t k = 0; k < n; ++k) centre[k] += simplex[c].at[k] / static_cast<double>(n);
    Corner& worst = simplex.back();
    const auto along = [&](double factor) {
      std::vector<double> at(n);
      for (std::size_t k = 0; k < n; ++k) at[k] = centre[k] + factor * (worst.at[k] - centre[k]);
      return corner_at(std::move(at));
    };
    Corner reflected = along(-1.0);
    if (reflected.value < simplex.front().value) {
      Corner expanded = along(-2.0);
      worst = expanded.value < reflected.value ? std::move(expanded) : std::move(reflected);
    } else if (reflected.value < simplex[n - 1].value) {
      worst = std::move(reflected);
    } else {
      const bool outside = reflected.value < worst.value;
      Corner contracted = along(outside ? -0.5 : 0.5);
      if (contracted.value < std::min(worst.value, reflected.value)) {
        worst = std::move(contracted);
      } else {
        const std::vector<double> best = simplex.front().at;
        for (std::size_t c = 1; c <= n; ++c) {
          for (std::size_t k = 0; k < n; ++k) simplex[c].at[k] = best[k] + 0.5 * (simplex[c].at[k] - best[k]);
          simplex[c] = corner_at(simplex[c].at);
        }
      }
    }
  }
  return simplex.front().at;
}

}  // namespace odolab
