// What the filters over truth samples have in common: how they walk through a run, where they begin, what they leave
// out and where they start anew; what is hidden behind a count; and an innovation as it is told.
#pragma once

#include <cmath>

#include "core/calibration/innovations.h"
#include "core/calibration/pose_covariance.h"

namespace odolab {

// Of the pose in its own frame: the rounding of both wheels' rotations at one reading.
inline PoseCovariance count_error(const InnovationRun& run, const DifferentialDrive& drive) {
  const double count = count_rad(run, drive), of_one = 12.0 * run.readings_averaged, b = drive.wheelbase_m;
  const double left = std::pow(count * drive.wheel_radius_left_m, 2) / of_one,
               right = std::pow(count * drive.wheel_radius_right_m, 2) / of_one;
  return {0.25 * (left + right), 0.0, 0.5 * (right - left) / b, 0.0, 0.0, (left + right) / (b * b)};
}

// Of `residual` and `white` three numbers each.
inline Innovation innovation_of(double time_s, int truth_index, int size, const double* residual, const double* white,
                                const PoseCovariance& covariance, double squared, bool set_aside) {
  Innovation out;
  out.time_s = time_s;
  out.truth_index = truth_index;
  out.size = size;
  for (int j = 0; j < 3; ++j) out.residual[j] = residual[j], out.white[j] = white[j];
  covariance.pack(out.covariance);
  out.squared = squared;
  out.set_aside = set_aside;
  return out;
}

constexpr char kRestartHere = 2;  // of what is set aside

// `Filter`: begin_at(k) begins anew at a sample, predict(t) goes on from it to the next, update(k) takes that in or
// refuses it by the gate, pass_by(k) goes by one that is set aside. `sums.set_aside` is filled in, and the restarts.
template <typename Filter>
void walk(const InnovationRun& run, const FilterOptions& options, Filter& filter, InnovationSums& sums) {
  const int last = options.last < 0 ? static_cast<int>(run.truth.size()) : options.last;
  sums.set_aside = options.gate > 0.0 ? std::vector<char>(run.truth.size(), 0) : run.set_aside;
  int start = options.first;
  if (options.gate <= 0.0)
    while (start + 1 < last && run.set_aside[start]) ++start;
  filter.begin_at(start);
  int refused = 0;
  bool lost = false;  // behind a cut, until there is a sample to start from
  for (int t = start; t + 1 < last; ++t) {
    const int k = t + 1;
    lost = lost || is_cut(run, k);
    if (lost) {
      filter.begin_at(k);
      refused = 0;
      lost = options.gate <= 0.0 && run.set_aside[k];
      continue;
    }
    filter.predict(t);
    if (options.gate <= 0.0 && run.set_aside[k]) {
      refused = run.set_aside[k] == kRestartHere ? 0 : refused;
      if (run.set_aside[k] == kRestartHere)
        filter.begin_at(k);
      else
        filter.pass_by(k);
      continue;
    }
    if (filter.update(k)) {
      refused = 0;
    } else if (++refused >= options.contradiction) {
      filter.begin_at(k);
      sums.set_aside[k] = kRestartHere;
      ++sums.restarts;
      refused = 0;
    }
  }
}

}  // namespace odolab
