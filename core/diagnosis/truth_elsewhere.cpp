#include "core/diagnosis/truth_elsewhere.h"

#include <algorithm>

#include "core/diagnosis/model/outlying.h"

namespace odolab {

TimeStretches truth_elsewhere(const InnovationRun& run, const InnovationModel& model) {
  constexpr double kMost_s = 2.0;
  TimeStretches found;
  if (run.truth.size() < 2) return found;
  const double period_s =
      (run.truth.back().time_s - run.truth.front().time_s) / static_cast<double>(run.truth.size() - 1);
  const int most = static_cast<int>(kMost_s / std::max(period_s, 1e-6));
  if (most <= kContradiction) return found;
  for (const Refused& r : refused_in_a_row(run, model, most))
    if (r.comes_back && r.end - r.first >= static_cast<std::size_t>(kContradiction))
      found.emplace_back(run.truth[r.first].time_s, run.truth[r.end - 1].time_s);
  return found;
}

}  // namespace odolab
