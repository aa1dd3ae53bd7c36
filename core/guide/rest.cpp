#include "core/guide/rest.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"

namespace odolab {

namespace {

constexpr double kStandardErrorsOfRule = 3.0;  // of the rule, section 6.3

}  // namespace

RestOfCalibration rest_of(const UmbmarkMeasure& measure, const UmbmarkRuns& runs) {
  const std::size_t cw = runs.clockwise.size(), ccw = runs.counter_clockwise.size();
  if (cw < 2 && ccw < 2)
    return {false, "One run each way leaves no spread: whether another compensation helps, nobody can tell."};
  const bool cw_is_worse = measure.clockwise.distance_m >= measure.counter_clockwise.distance_m;
  const double n = static_cast<double>(cw_is_worse ? cw : ccw);
  const double rest_m = measure.largest_systematic_error_m;
  const double times = rest_m / (std::max(measure.spread_m, kTapeRounding_m) / std::sqrt(n));
  if (times > kStandardErrorsOfRule)
    return {true, formatted("What is left, %.1f mm, is %.1f standard errors of its own centre: another compensation is "
                            "likely to help.",
                            1e3 * rest_m, times)};
  if (rest_m < kTapeRounding_m)
    return {false, formatted("Nothing is left to correct: %.1f mm is less than a tape tells apart.", 1e3 * rest_m)};
  if (rest_m <= measure.spread_m)
    return {false, formatted("Nothing is left to correct: %.1f mm is within the spread of the returns, %.1f standard "
                             "errors of its own centre.",
                             1e3 * rest_m, times)};
  return {false,
          formatted("What is left, %.1f mm, is %.1f standard errors of its own centre: another compensation would "
                    "fit chance.",
                    1e3 * rest_m, times)};
}

}  // namespace odolab
