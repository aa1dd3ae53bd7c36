// How a filter walks through the truth samples of a run: where it begins, what it leaves out, where it starts anew.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

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
