// A linked vehicle of which one wheel counts too little, on three runs and on one that is left out.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "test/support/linked_runs.h"

namespace odolab::test {

struct MiscountingRuns {
  Vehicle nominal;  // knows nothing of it
  std::vector<Recording> fitted;
  Recording left_out;
};

// Truck B's left wheel, or the trailer's, loses that share of its counts above 3 rad/s. `run` drives such a vehicle.
template <typename Kind, typename Run>
MiscountingRuns miscounting_runs(const Kind& vehicle, const Run& run, double share) {
  LinkedRunSettings s;
  const double fast_rad = 3.0 * s.step_s;
  s.b_left = [=](double, double, double by_rad) { return std::abs(by_rad) > fast_rad ? -share * by_rad : 0.0; };
  MiscountingRuns made;
  made.nominal.kind = vehicle;
  for (const std::uint64_t seed : {51, 52, 53}) made.fitted.push_back(run(vehicle, s, seed));
  made.left_out = run(vehicle, s, 61);
  made.left_out.name = "left out.csv";
  return made;
}

// Of numbers that are there.
inline double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace odolab::test
