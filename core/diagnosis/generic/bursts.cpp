#include "core/diagnosis/generic/bursts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/trembling_truth.h"
#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/model/coarse_counts.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/shape_search.h"
#include "core/diagnosis/naming/undone.h"

namespace odolab {

namespace {

constexpr double kBurstsApart_s = 1.0;
// The mean excess of one moment is 2.16, and so is that of the largest of each second: 2.17 over 122 sets of five
// programs in which nothing is missing. Noise with a heavier tail is noise still: with this mean the least likely of
// them came to 0.03.
constexpr double kByNoise = 3.3;
constexpr std::size_t kFewestBursts = 5;

double sum_of_bursts(const std::vector<Burst>& bursts) {
  return std::accumulate(bursts.begin(), bursts.end(), 0.0, [](double sum, const Burst& b) { return sum + b.excess; });
}

std::string bursts_in_words(const std::vector<Burst>& bursts, const JointModel& joint) {
  constexpr std::size_t kMostSaid = 3;
  std::string words;
  for (std::size_t k = 0; k < std::min(bursts.size(), kMostSaid); ++k) {
    words += (k == 0 ? "" : ", ") + joint.runs()[static_cast<std::size_t>(bursts[k].run)].name +
             formatted(" at %.1f s", bursts[k].at_s);
  }
  return words;
}

// How much wider than chi-square the moments about one scatter, by their median, which no burst moves.
double scatter_about(const SearchedShapes& moments, std::size_t n) {
  const std::vector<double>& at = moments.shapes[moments.of_shape[n]];
  std::vector<double> about;
  for (std::size_t k = 0; k < moments.statistics.size(); ++k) {
    const std::vector<double>& shape = moments.shapes[moments.of_shape[k]];
    const double away_s = std::abs(shape[1] - at[1]);
    if (shape[0] == at[0] && away_s < TremblingTruth::kAbout_s && away_s > kBurstsApart_s)
      about.push_back(moments.statistics[k]);
  }
  return median(std::move(about)) / kMiddleOfAPush;
}

// A moment after which the truth is soon back where the wheels went is no doing of the vehicle.
void leave_out_the_truths_own(std::vector<Burst>& bursts, const CandidateScan& scan) {
  std::vector<char> is_undone(bursts.size(), 0);
  parallel_for(static_cast<int>(bursts.size()), [&](int k) {
    const Burst& b = bursts[static_cast<std::size_t>(k)];
    const CandidateTest away = away_for_a_while(scan, b.run, b.at_s);
    is_undone[static_cast<std::size_t>(k)] =
        away.statistic / b.scatter > b.excess + kNinetySevenOfAPush + away_by_chance();
  });
  std::size_t k = 0;
  std::erase_if(bursts, [&](const Burst&) { return is_undone[k++] != 0; });
}

}  // namespace

std::vector<Burst> bursts_of(std::vector<Burst> statistics) {
  std::vector<Burst> bursts;
  double last_s = 0.0;
  for (Burst& b : statistics) {
    b.excess -= kNinetySevenOfAPush;
    if (b.excess <= 0.0) continue;
    if (bursts.empty() || bursts.back().run != b.run || b.at_s - last_s > kBurstsApart_s)
      bursts.push_back(b);
    else if (b.excess > bursts.back().excess)
      bursts.back() = b;
    last_s = b.at_s;
  }
  std::stable_sort(bursts.begin(), bursts.end(), [](const Burst& a, const Burst& b) { return a.excess > b.excess; });
  return bursts;
}

double chance_of(const std::vector<Burst>& bursts) {
  // Excesses fall off exponentially: twice their sum, in means, is a chi-square of twice as many.
  return chi_square_tail(2.0 * sum_of_bursts(bursts) / kByNoise, 2 * static_cast<int>(bursts.size()));
}

double beyond_noise(const std::vector<Burst>& bursts) {
  return sum_of_bursts(bursts) - kByNoise * static_cast<double>(bursts.size());
}

double doubt_of_moments(const JointModel& joint) {
  constexpr double kPerOdds = 2.0;  // as of names that stand though doubted
  const double distrust = joint.distrust(true);
  const double wider = joint.wider_by_correlation();
  return distrust < 1.0 ? std::min(1.0 + kPerOdds * distrust / (1.0 - distrust), wider) : wider;
}

bool hides_behind_counts(const std::vector<double>& push, const JointModel& joint) {
  constexpr double kCounts = 1.5;
  const double displaced_m = std::hypot(push[0], push[1]) + 0.5 * joint.model.drive.wheelbase_m * std::abs(push[2]);
  return displaced_m <= kCounts * largest_count_m(joint);
}

std::optional<Unnamed> what_comes_in_bursts(const JointModel& joint, double explained, double error) {
  if (is_nothing(joint.gathered_error()) || counts_are_coarse(joint)) return std::nullopt;
  // Of a truth that is made up of several instruments place and heading err together, and each error would be a push.
  if (joint.truth_errors) return std::nullopt;
  const Effect& push = push_from_outside();
  const CandidateScan scan(joint, JointModel::kNone);
  const SearchedShapes moments = best_shape(joint.views(), scan, push);
  if (moments.statistics.empty()) return std::nullopt;
  const double scatter = std::max(doubt_of_moments(joint), scatter_of_statistics(moments.statistics, kFreedomOfAPush));
  const TremblingTruth truth(joint);
  std::vector<Burst> all;
  for (std::size_t n = 0; n < moments.statistics.size(); ++n) {
    const std::vector<double>& shape = moments.shapes[moments.of_shape[n]];
    double divisor = scatter;
    if (moments.statistics[n] / scatter > kNinetySevenOfAPush) {
      if (hides_behind_counts(scan.test(push, shape).value, joint)) continue;
      // Both must say so: the moments about it are wide by what goes on for seconds, too, and a truth that trembles
      // more need not make them wide.
      const double wide = std::min(truth.worse(static_cast<int>(shape[0]), shape[1]), scatter_about(moments, n));
      divisor = std::max(scatter, wide);
    }
    all.push_back({static_cast<int>(shape[0]), shape[1], moments.statistics[n] / divisor, divisor});
  }
  std::sort(all.begin(), all.end(), [](const Burst& a, const Burst& b) {
    return std::pair{a.run, a.at_s} < std::pair{b.run, b.at_s};
  });
  std::vector<Burst> bursts = bursts_of(std::move(all));
  const auto are_worth_saying = [&] {
    return bursts.size() >= kFewestBursts && chance_of(bursts) <= error &&
           beyond_noise(bursts) >= kMostLeft * explained;
  };
  if (!are_worth_saying()) return std::nullopt;
  leave_out_the_truths_own(bursts, scan);
  if (!are_worth_saying()) return std::nullopt;
  Unnamed u;
  u.p_value = chance_of(bursts);
  u.gain = beyond_noise(bursts);
  u.where.regime = "what happens at moments of its own, larger and more often than noise makes it (most of it in " +
                   bursts_in_words(bursts, joint) + ")";
  return u;
}

}  // namespace odolab
