// Mean and standard deviation of what several runs gave, as a figure.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "physics/experiments/experiment.h"

namespace odolab {

struct MeanAndSpread {
  double mean = 0.0;
  double spread = 0.0;  // standard deviation; 0 where there is one value or none
};

inline MeanAndSpread mean_and_spread(const std::vector<double>& values) {
  MeanAndSpread result;
  const double n = static_cast<double>(values.size());
  if (values.empty()) return result;
  for (const double v : values) result.mean += v / n;
  if (values.size() < 2) return result;
  double squares = 0.0;
  for (const double v : values) squares += (v - result.mean) * (v - result.mean);
  result.spread = std::sqrt(squares / (n - 1.0));
  return result;
}

inline Figure figure_of(std::string name, std::string unit, const std::vector<double>& values,
                        std::optional<double> published_low = {}, std::optional<double> published_high = {}) {
  const MeanAndSpread m = mean_and_spread(values);
  return {.name = std::move(name),
          .unit = std::move(unit),
          .published_low = published_low,
          .published_high = published_high ? published_high : published_low,
          .ours = m.mean,
          .ours_spread = m.spread,
          .seeds = static_cast<int>(values.size())};
}

}  // namespace odolab
