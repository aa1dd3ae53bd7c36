#include "core/calibration/innovations.h"

#include <algorithm>
#include <limits>

#include "core/calibration/lasting_truth_filter.h"
#include "core/calibration/noise_slopes.h"
#include "core/calibration/pose_filter.h"

namespace odolab {

FittedNoise as_large_as_any_real(FittedNoise noise) {
  constexpr double kLeast = 2e-5;
  noise.wheel_m_per_sqrt_m = std::max(noise.wheel_m_per_sqrt_m, kLeast);
  noise.truth_position_m = std::max(noise.truth_position_m, kLeast);
  noise.truth_heading_rad = std::max(noise.truth_heading_rad, kLeast);
  constexpr double kLeastWander = 0.1 * kLeast;
  noise.wander_m_per_sqrt_s = std::max(noise.wander_m_per_sqrt_s, kLeastWander);
  noise.heading_wander_rad_per_sqrt_s = std::max(noise.heading_wander_rad_per_sqrt_s, kLeastWander);
  constexpr double kLeastTiming_s = 1e-4;
  if (noise.command_timing_s > 0.0) noise.command_timing_s = std::max(noise.command_timing_s, kLeastTiming_s);
  return noise;
}

namespace {

int end_of(const InnovationRun& run, const FilterOptions& options) {
  return options.last < 0 ? static_cast<int>(run.truth.size()) : options.last;
}

InnovationSums passed_once(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                           const FilterOptions& options, const UnknownHeading* begins = nullptr) {
  if (!options.derivatives && model.noise.wander_lasts_s > 0.0)
    return LastingTruthFilter(run, summed, model, options).run();
  if (!options.derivatives) return PoseFilter<kNoColumns>(run, summed, model, options, nullptr, begins).run();
  if (summed.columns == column::first_extra)
    return PoseFilter<kUsualColumns>(run, summed, model, options, nullptr, begins).run();
  return PoseFilter<kAnyColumns>(run, summed, model, options, nullptr, begins).run();
}

// What each of several sums says, by its weight: README, Eq. 7b.
InnovationSums over_headings(const std::vector<InnovationSums>& sums) {
  std::vector<double> likelihoods;
  for (const InnovationSums& s : sums) likelihoods.push_back(s.chi2 + s.log_determinant);
  const HeadingsWeighed by = headings_weighed(likelihoods);
  const auto add = [](std::vector<double>& to, const std::vector<double>& of, double weight) {
    to.resize(of.size(), 0.0);
    for (std::size_t i = 0; i < of.size(); ++i) to[i] += weight * of[i];
  };
  InnovationSums out;
  out.scalars = sums[0].scalars;
  out.set_aside = sums[0].set_aside;
  out.batch_scores.resize(sums[0].batch_scores.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    out.chi2 += by.weight[k] * sums[k].chi2;
    add(out.information, sums[k].information, by.weight[k]);
    add(out.score, sums[k].score, by.weight[k]);
    for (std::size_t b = 0; b < out.batch_scores.size(); ++b)
      add(out.batch_scores[b], sums[k].batch_scores[b], by.weight[k]);
  }
  out.log_determinant = by.minus_two_log_likelihood - out.chi2;
  return out;
}

// Of whom each innovation is asked gets those of one heading.
InnovationSums passed(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                      const FilterOptions& options) {
  if (options.gate > 0.0 || options.on_innovation || options.on_step || model.noise.wander_lasts_s > 0.0)
    return passed_once(run, summed, model, options);
  std::vector<InnovationSums> sums;
  for (const UnknownHeading& begins : headings_all_around(run, summed, model, options.first, end_of(run, options)))
    sums.push_back(passed_once(run, summed, model, options, &begins));
  return sums.empty() ? passed_once(run, summed, model, options) : over_headings(sums);
}

// By the gate. What comes behind an outlier at the very start contradicts it: then the filter starts at the first
// sample with which nearly all that follow agree.
InnovationSums gated(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                     const FilterOptions& options) {
  constexpr int kFollow = 5, kDisagree = 4, kMostSkipped = 3;
  const auto refused_behind = [&](const InnovationSums& sums, int first) {
    const auto from = sums.set_aside.begin() + first + 1;
    return std::count_if(from, std::min(from + kFollow, sums.set_aside.end()), [](char aside) { return aside != 0; });
  };
  InnovationSums as_given = passed(run, summed, model, options);
  const int samples = static_cast<int>(run.truth.size());
  for (int skipped = 1; skipped <= kMostSkipped && options.first + skipped + kFollow < samples; ++skipped) {
    if (refused_behind(as_given, options.first) < kDisagree) break;
    FilterOptions later = options;
    later.first += skipped;
    InnovationSums sums = passed(run, summed, model, later);
    if (refused_behind(sums, later.first) > kFollow - kDisagree) continue;
    std::fill(sums.set_aside.begin() + options.first, sums.set_aside.begin() + later.first, char{1});
    return sums;
  }
  return as_given;
}

// Nothing says which of a few samples errs, as of the poses at both ends of a run: what all of those behind the way
// contradict is what the wheels say of it.
bool says_which_err(const std::vector<TruthSample>& truth) {
  constexpr std::size_t kFewest = 5, kMostAtBothEnds = 50;
  if (truth.size() < kFewest) return false;
  if (truth.size() > kMostAtBothEnds) return true;
  double longest_s = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) longest_s = std::max(longest_s, truth[i].time_s - truth[i - 1].time_s);
  return longest_s < 0.5 * (truth.back().time_s - truth.front().time_s);
}

}  // namespace

InnovationSums filtered(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                        const FilterOptions& options) {
  if (options.gate <= 0.0) return passed(run, summed, model, options);
  if (says_which_err(run.truth)) return gated(run, summed, model, options);
  FilterOptions open = options;
  open.gate = std::numeric_limits<double>::infinity();
  return passed(run, summed, model, open);
}

std::vector<std::pair<int, int>> contradictions(const InnovationRun& run, const SummedRun& summed,
                                                const InnovationModel& model) {
  FilterOptions options;
  options.derivatives = false;
  options.gate = kGate;
  const std::vector<char> aside = filtered(run, summed, model, options).set_aside;
  std::vector<std::pair<int, int>> found;
  for (int k = 0; k < static_cast<int>(aside.size()); ++k) {
    if (aside[k] != kRestartHere) continue;
    int first = k;
    while (first > 0 && aside[first - 1] == 1) --first;
    found.emplace_back(first, k);
  }
  return found;
}

NoiseSlopes noise_slopes(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model, int first,
                         int last) {
  FilterOptions options;
  options.derivatives = false;
  options.first = first;
  options.last = last;
  if (model.noise.wander_lasts_s > 0.0) return LastingTruthFilter(run, summed, model, options).slopes();
  const auto slopes_of = [&](const UnknownHeading* begins) {
    NoiseCarry carried;
    const InnovationSums sums = PoseFilter<kNoColumns>(run, summed, model, options, &carried, begins).run();
    NoiseSlopes out;
    out.value = sums.chi2 + sums.log_determinant;
    out.scalars = sums.scalars;
    for (int k = 0; k < noise_size::count; ++k) {
      out.slope[k] = carried.slope(k);
      for (int j = 0; j < noise_size::count; ++j) out.curvature[noise_size::count * k + j] = carried.curvature(k, j);
    }
    return out;
  };
  std::vector<NoiseSlopes> all;
  std::vector<double> likelihoods;
  for (const UnknownHeading& begins : headings_all_around(run, summed, model, first, end_of(run, options))) {
    all.push_back(slopes_of(&begins));
    likelihoods.push_back(all.back().value);
  }
  if (all.empty()) return slopes_of(nullptr);
  const HeadingsWeighed by = headings_weighed(likelihoods);
  NoiseSlopes out;
  out.value = by.minus_two_log_likelihood;
  out.scalars = all[0].scalars;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (std::size_t i = 0; i < out.slope.size(); ++i) out.slope[i] += by.weight[k] * all[k].slope[i];
    for (std::size_t i = 0; i < out.curvature.size(); ++i) out.curvature[i] += by.weight[k] * all[k].curvature[i];
  }
  return out;
}

}  // namespace odolab
