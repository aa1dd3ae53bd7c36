// Least squares over stretches of a run, of what a vehicle's own encoders contradict: weak priors about the vehicle
// file, Huber weights against bumps, standard errors that know how rounding hangs together. `linked` and `trailer`
// stand on it.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/least_squares.h"

namespace odolab {

struct StretchProblem {
  // An absolute encoder, which is read at both ends of a stretch.
  struct Encoder {
    int contradiction = 0;  // that its reading at the end enters as it is
    int offset = 0;         // the unknown that is its bias
    double step = 0.0;      // of its readings; 0: continuous
    std::function<double(int stretch, bool at_end)> reading;
  };

  int stretches = 0;
  // How far each unknown, a departure from the vehicle file, is expected from 0 at most: wide beside what recordings
  // tell, so that only what they cannot tell is held.
  std::vector<double> prior;
  std::vector<double> least_deviation;  // of each contradiction: rounding
  std::vector<Encoder> encoders;
  // What is read at a stretch's end less what its start and the wheels predict, for these unknowns.
  std::function<std::vector<double>(int stretch, const std::vector<double>& x)> contradictions;
};

struct StretchFit {
  std::vector<double> x;           // of all unknowns; 0 where not free
  std::vector<double> covariance;  // row by row
  std::vector<double> prior;

  // Known to a fifth of its prior's width or better.
  bool determined(int unknown) const;
  double variance_along(const std::vector<double>& slope) const;  // of a number with this slope in the unknowns
};

// Gauss-Newton over the `free` unknowns. Stops early where `progress` says so.
StretchFit fit_stretches(const StretchProblem& problem, const std::vector<int>& free, const Progress& progress = {});

// One number of a vehicle file and the unknowns that it follows from.
template <typename Lengths>
struct StretchParameter {
  const char* name;
  const char* unit;
  double (*value)(const Lengths& lengths);
  std::vector<int> from;
};

// Its estimate, where `with(nominal, x)` are the lengths with the unknowns put in.
template <typename Lengths, typename With>
ParameterEstimate estimate_of(const StretchParameter<Lengths>& p, const Lengths& nominal, const With& with,
                              const StretchFit& fit) {
  bool known = true;
  std::vector<double> slope(fit.x.size(), 0.0);
  for (int unknown : p.from) {
    known = known && fit.determined(unknown);
    const std::size_t k = static_cast<std::size_t>(unknown);
    std::vector<double> more = fit.x, less = fit.x;
    more[k] += 1e-6;
    less[k] -= 1e-6;
    slope[k] = (p.value(with(nominal, more)) - p.value(with(nominal, less))) / 2e-6;
  }
  return {p.name, p.unit, p.value(nominal), p.value(with(nominal, fit.x)), std::sqrt(fit.variance_along(slope)), known};
}

}  // namespace odolab
