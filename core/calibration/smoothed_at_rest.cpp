#include "core/calibration/smoothed_at_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/quantile.h"
#include "core/calibration/truth_at_rest.h"

namespace odolab {

namespace {

// Of ways over so many samples each: the products of those that follow each other, and their squares.
struct FollowingWays {
  double products = 0.0, squares = 0.0, count = 0.0;

  double correlation() const { return squares > 0.0 ? products / squares : 0.0; }
};

double usual_step_s(const std::vector<TruthAtRest>& rests) {
  std::vector<double> steps_s;
  for (const TruthAtRest& rest : rests)
    for (std::size_t i = 1; i < rest.time_s.size(); ++i) steps_s.push_back(rest.time_s[i] - rest.time_s[i - 1]);
  return median(std::move(steps_s));
}

FollowingWays following_ways(const std::vector<TruthAtRest>& rests, const std::vector<double> TruthAtRest::*channel,
                             std::size_t over, double step_s) {
  constexpr double kEven = 0.3, kFarthest = 3.5;  // of a step; in standard deviations, beyond which it moves
  std::vector<double> firsts, seconds;
  for (const TruthAtRest& rest : rests) {
    const std::vector<double>& values = rest.*channel;
    if (values.size() != rest.time_s.size()) continue;  // a heading now and then
    const auto is_even = [&](std::size_t from) {
      const double steps = (rest.time_s[from + over] - rest.time_s[from]) / step_s;
      return std::abs(steps - static_cast<double>(over)) <= kEven;
    };
    for (std::size_t i = 0; i + 2 * over < values.size(); ++i) {
      if (!is_even(i) || !is_even(i + over)) continue;
      firsts.push_back(values[i + over] - values[i]);
      seconds.push_back(values[i + 2 * over] - values[i + over]);
    }
  }
  const double scatter = scatter_about_zero(firsts),
               most = scatter > 0.0 ? kFarthest * scatter : std::numeric_limits<double>::infinity();
  FollowingWays sum;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    if (std::abs(firsts[i]) > most || std::abs(seconds[i]) > most) continue;
    sum.products += firsts[i] * seconds[i];
    sum.squares += 0.5 * (firsts[i] * firsts[i] + seconds[i] * seconds[i]);
    sum.count += 1.0;
  }
  return sum;
}

}  // namespace

// The way between independent samples goes back half of what it came: a correlation of -0.5. Within what a filter
// smooths it goes on, or knows nothing of the way before where that is a mean of samples (their second differences
// are zero); and so do what wanders, and wheels. Noise that fades from sample to sample goes back a little from the
// first on, -(1 - r) / 2 where neighbours are correlated by r: over half of the time by -0.22 where it is -0.35 over
// the whole.
std::optional<double> smoothed_for_s(const std::vector<Recording>& recordings, const DifferentialDrive& drive,
                                     double truth_late_s, bool by_commands) {
  constexpr double kFewest = 60.0;  // of each channel, of three: a standard error of 0.06 of their mean
  constexpr double kLongest_s = 0.3, kGoesBack = -0.25, kNeighbours = -0.2, kNearly = 0.8, kNearlyWhite = -0.35,
                   kAlmost = 0.9, kWhite = -0.42, kFades = -0.1;
  const std::vector<TruthAtRest> rests = truth_at_rest(recordings, drive, truth_late_s, by_commands);
  const double step_s = usual_step_s(rests);
  if (!(step_s > 0.0)) return std::nullopt;
  std::vector<double> correlation;
  for (std::size_t over = 1; static_cast<double>(over) * step_s <= kLongest_s; ++over) {
    double sum = 0.0, channels = 0.0;
    for (const auto channel : {&TruthAtRest::x_m, &TruthAtRest::y_m, &TruthAtRest::heading_rad}) {
      const FollowingWays ways = following_ways(rests, channel, over, step_s);
      if (ways.count < kFewest || ways.squares == 0.0) continue;
      sum += ways.correlation();
      channels += 1.0;
    }
    if (channels < 2.0) break;
    correlation.push_back(sum / channels);
    if (correlation.front() <= kNeighbours) return 0.0;
  }
  if (correlation.empty()) return std::nullopt;
  const double most = *std::min_element(correlation.begin(), correlation.end());
  if (most > kGoesBack) return std::nullopt;
  const auto first_beyond = [&](double share, double white) {
    const double beyond = std::max(share * most, white);
    const auto first = std::find_if(correlation.begin(), correlation.end(), [&](double c) { return c <= beyond; });
    return static_cast<std::size_t>(first - correlation.begin()) + 1;
  };
  const std::size_t nearly = first_beyond(kNearly, kNearlyWhite);
  if (correlation[nearly / 2 - 1] < kFades) return std::nullopt;
  // Of few samples chance would put it much farther out.
  return static_cast<double>(std::min(first_beyond(kAlmost, kWhite), nearly + nearly / 2)) * step_s;
}

}  // namespace odolab
