#include "core/diagnosis/quality/drawn_truth.h"

#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/frozen_truth.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

// How far a sample is off the line from the one before to the one behind.
struct OffTheLine {
  Vec2 by_m;
  double by_rad = 0.0, way_m = 0.0;
};

OffTheLine off_the_line(const TruthSample& before, const TruthSample& here, const TruthSample& behind) {
  const double share = (here.time_s - before.time_s) / (behind.time_s - before.time_s);
  const Vec2 step = behind.position - before.position;
  OffTheLine off;
  off.by_m = here.position - before.position - share * step;
  off.way_m = length(step);
  if (before.heading_rad && here.heading_rad && behind.heading_rad)
    off.by_rad =
        wrapped(*here.heading_rad - *before.heading_rad) - share * wrapped(*behind.heading_rad - *before.heading_rad);
  return off;
}

// Of white noise neighbours are off to opposite sides, by two thirds of the square of either; a smooth way is bent to
// the same.
bool trembles(const std::vector<OffTheLine>& off) {
  constexpr double kOpposite = -0.3;
  double product = 0.0, square = 0.0;
  for (std::size_t i = 1; i < off.size(); ++i)
    product += dot(off[i - 1].by_m, off[i].by_m), square += dot(off[i].by_m, off[i].by_m);
  return product < kOpposite * square;
}

}  // namespace

TimeStretches drawn_truth(const std::vector<TruthSample>& truth) {
  constexpr double kOfMeasured = 0.02;
  constexpr std::size_t kInARow = 4;
  TimeStretches drawn;
  if (truth.size() < 20) return drawn;
  std::vector<OffTheLine> off;  // of all samples but the first and the last
  std::vector<double> metres, radians;
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    off.push_back(truth[i + 1].time_s > truth[i - 1].time_s ? off_the_line(truth[i - 1], truth[i], truth[i + 1])
                                                            : OffTheLine{});
    if (off.back().way_m == 0.0) continue;
    metres.push_back(length(off.back().by_m));
    radians.push_back(std::abs(off.back().by_rad));
  }
  if (metres.size() < 20 || !trembles(off)) return drawn;
  // On a coarse grid whatever goes evenly goes in a line.
  constexpr double kStepOfUsual = 0.25;
  if (least_step_m(truth) > kStepOfUsual * median(metres)) return drawn;
  const double usual_m = median(metres), most_m = kOfMeasured * usual_m, most_rad = kOfMeasured * median(radians);
  // Where it hardly moves, a truth may tremble less; but not for long, and get somewhere.
  constexpr std::size_t kForLong = 12;
  constexpr double kSomewhere = 3.0;  // of what it is off as a rule
  std::size_t first = 0;
  for (std::size_t i = 0; i <= off.size(); ++i) {
    if (i < off.size() && length(off[i].by_m) <= most_m && std::abs(off[i].by_rad) <= most_rad) continue;
    const std::size_t row = i - first;
    if (row >= kInARow) {
      double way_m = 0.0;
      for (std::size_t k = first; k < i; ++k) way_m += off[k].way_m;
      const double gone_m = length(truth[i + 1].position - truth[first].position);
      if (way_m > usual_m * static_cast<double>(row) || (row >= kForLong && gone_m > kSomewhere * usual_m))
        drawn.emplace_back(truth[first].time_s, truth[i + 1].time_s);
    }
    first = i + 1;
  }
  return drawn;
}

}  // namespace odolab
