#include "core/guide/misfit.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/guide/rest.h"

namespace odolab {

namespace {

constexpr double kTimesTheSpread = 5.0;
constexpr double kMedianOfRayleigh = 1.17741002;  // sqrt(2 ln 2), in standard deviations of one coordinate
constexpr int kEnough = 4;

}  // namespace

const char* misfit_rule() {
  return "A run is marked where it lies further from the median point of its direction than five times the spread of "
         "all "
         "runs (median distance over 1.18). It counts as long as nobody leaves it out.";
}

std::vector<bool> misfits(const GuideRound& round) {
  std::vector<bool> marked(round.runs.size(), false);
  std::vector<double> distances(round.runs.size(), 0.0), counted_distances;
  for (const bool clockwise : {true, false}) {
    std::vector<double> x, y;
    for (const GuideRun& run : round.runs)
      if (run.clockwise == clockwise && !run.left_out) {
        x.push_back(return_error(run).x_m);
        y.push_back(return_error(run).y_m);
      }
    if (static_cast<int>(x.size()) < kEnough) continue;
    const Vec2 middle{median(x), median(y)};
    for (std::size_t i = 0; i < round.runs.size(); ++i) {
      if (round.runs[i].clockwise != clockwise) continue;
      const ReturnError e = return_error(round.runs[i]);
      distances[i] = length(Vec2{e.x_m, e.y_m} - middle);
      if (!round.runs[i].left_out) counted_distances.push_back(distances[i]);
    }
  }
  if (counted_distances.empty()) return marked;
  const double spread_m = std::max(kTapeRounding_m, median(counted_distances) / kMedianOfRayleigh);
  for (std::size_t i = 0; i < marked.size(); ++i) marked[i] = distances[i] > kTimesTheSpread * spread_m;
  return marked;
}

}  // namespace odolab
