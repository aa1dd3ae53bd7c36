#include "core/diagnosis/truth_elsewhere.h"

#include <algorithm>

#include "core/diagnosis/model/outlying.h"

namespace odolab {

namespace {

TimeStretches refused_times(const std::vector<Refused>& refused, const InnovationRun& run) {
  TimeStretches times;
  for (const Refused& r : refused) times.emplace_back(run.truth[r.first].time_s, run.truth[r.end - 1].time_s);
  return times;
}

}  // namespace

TimeStretches truth_elsewhere(const InnovationRun& run, const InnovationModel& model) {
  constexpr double kMost_s = 2.0;
  // For longer only what is gone from one sample to the next, by five times of what is refused, and back as any sample:
  // the further the wheels go, the less is known of where they come to.
  constexpr double kMostWhereFar_s = 30.0, kFar = 25.0;
  if (run.truth.size() < 2) return {};
  const double period_s =
      (run.truth.back().time_s - run.truth.front().time_s) / static_cast<double>(run.truth.size() - 1);
  const auto samples_in = [&](double lasts_s) { return static_cast<int>(lasts_s / std::max(period_s, 1e-6)); };
  const int most = samples_in(kMost_s), most_where_far = samples_in(kMostWhereFar_s);
  bool some_stay_away = false;
  std::vector<Refused> found;
  if (most > kContradiction)
    for (const Refused& r : refused_in_a_row(run, model, most)) {
      if (r.end - r.first < static_cast<std::size_t>(kContradiction)) continue;
      if (r.comes_back)
        found.push_back(r);
      else
        some_stay_away = true;
    }
  if (!some_stay_away && most > kContradiction) return refused_times(found, run);
  if (most_where_far <= kContradiction) return refused_times(found, run);
  for (const Refused& r : refused_in_a_row(run, model, most_where_far)) {
    const auto overlaps = [&](const Refused& known) { return known.first < r.end && r.first < known.end; };
    if (r.comes_back && r.end - r.first >= static_cast<std::size_t>(kContradiction) && r.least_squared > kFar * kGate &&
        r.squared_behind < kGate && std::none_of(found.begin(), found.end(), overlaps))
      found.push_back(r);
  }
  std::sort(found.begin(), found.end(), [](const Refused& a, const Refused& b) { return a.first < b.first; });
  return refused_times(found, run);
}

}  // namespace odolab
