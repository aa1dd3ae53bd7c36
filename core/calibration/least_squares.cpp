#include "core/calibration/least_squares.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/calibration/calibrated_by_all.h"
#include "core/calibration/carried_truth.h"
#include "core/calibration/column_names.h"
#include "core/calibration/correlated_truth.h"
#include "core/calibration/smoothed_at_rest.h"
#include "core/calibration/turned_mounting.h"
#include "core/calibration/unfiltered_truth.h"

namespace odolab {

namespace {

// Where the moments say that they are elsewhere than the fit has them; empty where not, or where a clock is shared.
std::vector<AlignedClock> moved_clocks(const std::vector<Recording>& recordings, const LeastSquaresCalibration& fit,
                                       const LeastSquaresOptions& options) {
  const auto* drive = std::get_if<DifferentialDrive>(&fit.vehicle.kind);
  if (!drive || fit.time_offset_s.size() != recordings.size() || options.one_truth_clock) return {};
  std::vector<InnovationRun> runs;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    Result<InnovationRun> run = innovation_run(recordings[r], fit.vehicle, options.left_out_of(r));
    if (!run) return {};
    runs.push_back(std::move(*run));
  }
  const auto model_of = [&](int run) {
    InnovationModel model{*drive, fit.vehicle.truth, fit.noise};
    model.truth.time_offset_s = fit.time_offset_s[static_cast<std::size_t>(run)];
    return model;
  };
  return moved_clocks(runs, model_of).value_or(std::vector<AlignedClock>{});
}

// One count of the encoder that is read most coarsely, on the floor; zero where readings are not rounded.
double largest_count_m(const std::vector<Recording>& recordings, const Vehicle& vehicle) {
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  double largest_rad = 0.0;
  for (const Recording& recording : recordings)
    if (drive)
      if (const Result<InnovationRun> run = innovation_run(recording, vehicle))
        largest_rad = std::max(largest_rad, count_rad(*run, *drive));
  return drive ? largest_rad * std::max(drive->wheel_radius_left_m, drive->wheel_radius_right_m) : 0.0;
}

bool counts_are_a_long_way(double count_m, const FittedNoise& noise) {
  constexpr double kLong_m = 0.005, kBeyondTruth = 3.0;
  return count_m > kLong_m && count_m > kBeyondTruth * noise.truth_position_m;
}

// By samples of the truth that are so far apart.
Result<LeastSquaresCalibration> calibrated_by_samples_apart(double apart_s, const std::vector<Recording>& recordings,
                                                            const Vehicle& nominal, const LeastSquaresOptions& options,
                                                            const Progress& progress) {
  std::vector<Recording> thinned;
  for (const Recording& recording : recordings) thinned.push_back(with_truth_apart(recording, apart_s));
  return calibrated_by_all(thinned, nominal, options, progress);
}

// By what had been measured, where that was filtered.
std::optional<LeastSquaresCalibration> before_a_filter(const LeastSquaresCalibration& all,
                                                       const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                       const LeastSquaresOptions& options, const Progress& progress) {
  if (options.truth_is_unfiltered || options.by_commands ||
      counts_are_a_long_way(largest_count_m(recordings, nominal), all.noise))
    return std::nullopt;
  return calibrated_unfiltered(all, recordings, nominal, options, progress);
}

constexpr double kLasting = 0.2;  // by which neighbours may be correlated at most where fewer samples are used

double next_to_each_other(const LeastSquaresCalibration& c) {
  return std::max({c.correlation[0], c.correlation[1], c.correlation[2]});
}

// Beyond what a truth is smoothed where it rests; nothing where samples so far apart still know of each other: of what
// wanders, or of what is missing.
std::optional<Result<LeastSquaresCalibration>> calibrated_beyond_smoothing(double for_s,
                                                                           const std::vector<Recording>& recordings,
                                                                           const Vehicle& nominal,
                                                                           const LeastSquaresOptions& options,
                                                                           const Progress& progress) {
  if (for_s == 0.0) return std::nullopt;
  if (!options.truth_is_unfiltered && !options.by_commands) {
    Result<LeastSquaresCalibration> all = calibrated_by_all(recordings, nominal, options, {});
    if (!all) return all;
    if (auto measured = before_a_filter(*all, recordings, nominal, options, progress)) return measured;
  }
  Result<LeastSquaresCalibration> of_fewer = calibrated_by_samples_apart(for_s, recordings, nominal, options, progress);
  if (!of_fewer) return of_fewer;
  if (next_to_each_other(*of_fewer) > kLasting) return std::nullopt;
  of_fewer->truth_apart_s = for_s;
  of_fewer->warnings.push_back(formatted(
      "where the vehicle rests the truth is smoothed over %.2g s: only samples so far apart were used", for_s));
  return of_fewer;
}

double smoothed_at_rest_for_s(const std::vector<Recording>& recordings, const Vehicle& nominal, bool by_commands) {
  const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  return drive ? smoothed_for_s(recordings, *drive, nominal.truth.time_offset_s, by_commands).value_or(0.0) : 0.0;
}

// Of fewer samples of the truth, where its noise lasts from one to the next.
Result<LeastSquaresCalibration> calibrated_by_white_truth(const std::vector<Recording>& recordings,
                                                          const Vehicle& nominal, const LeastSquaresOptions& options,
                                                          const Progress& progress) {
  // A missing effect correlates innovations too, but less, or over as long as a manoeuvre lasts: then none that are
  // further apart are white.
  constexpr double kNext = 0.5, kOfManoeuvres = 0.5, kWhite = 0.06, kWhiter = 0.33;
  const auto next = next_to_each_other;
  Result<LeastSquaresCalibration> all = calibrated_by_all(recordings, nominal, options, progress);
  const auto is_white = [&](const LeastSquaresCalibration& c) {
    return next(c) < kNext && c.lasting_correlation < kWhite;
  };
  if (!all || is_white(*all)) return all;
  // What the base, or the mast that carries its marker, does late or swings with correlates them as a tracker that
  // smooths does, but not where it stands.
  if (const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind)) {
    const std::optional<double> at_rest =
        correlation_at_rest(recordings, *drive, nominal.truth.time_offset_s, options.by_commands);
    if (at_rest && *at_rest <= kLasting) return all;
  }
  const auto unfiltered = [&] { return before_a_filter(*all, recordings, nominal, options, progress); };
  if (all->correlation_after_1_s > kOfManoeuvres) return unfiltered().value_or(*all);
  // Clocks that run apart correlate them just so, and that is no noise.
  LeastSquaresOptions clocks_right = options;
  clocks_right.clocks = moved_clocks(recordings, *all, options);
  const bool clocks_are_off = !clocks_right.clocks.empty();
  if (clocks_are_off) {
    const auto put_right = calibrated_by_all(recordings, nominal, clocks_right, progress);
    if (put_right && is_white(*put_right)) return all;
  }
  if (auto measured = unfiltered()) return *std::move(measured);
  constexpr std::array<double, 7> kApart_s = {0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0};
  const auto of_samples_apart = [&](double apart_s, const LeastSquaresOptions& with) {
    return calibrated_by_samples_apart(apart_s, recordings, nominal, with, {});
  };
  // What sways slowly and little is no such noise, and is not seen any more in samples that are far apart.
  constexpr std::size_t kOfLittle = 5;
  std::vector<std::optional<Result<LeastSquaresCalibration>>> tried(
      all->lasting_correlation >= kLasting ? kApart_s.size() : kOfLittle);
  parallel_for(static_cast<int>(tried.size()), [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    tried[at] = of_samples_apart(kApart_s[at], clocks_right);
  });
  if (!goes_on(progress, 1.0)) return Error{"calibration", "stopped before its end", ""};
  const auto first_within = [&](double lasting) {
    return std::find_if(tried.begin(), tried.end(), [&](const auto& of_fewer) {
      return *of_fewer && next(**of_fewer) <= kLasting && (*of_fewer)->lasting_correlation <= lasting;
    });
  };
  auto found = first_within(std::max(kWhite, kWhiter * all->lasting_correlation));
  if (found == tried.end() && (next(*all) >= kNext || all->lasting_correlation >= kLasting))
    found = first_within(kLasting);
  if (found == tried.end()) return all;
  const double apart_s = kApart_s[static_cast<std::size_t>(found - tried.begin())];
  Result<LeastSquaresCalibration> of_fewer = clocks_are_off ? of_samples_apart(apart_s, options) : std::move(**found);
  if (!of_fewer) return of_fewer;
  of_fewer->truth_apart_s = apart_s;
  // Wheels that stand between two counts are as far off at one sample of the truth as at the next.
  const double count_m = largest_count_m(recordings, nominal);
  of_fewer->warnings.push_back(
      counts_are_a_long_way(count_m, of_fewer->noise)
          ? formatted("what truth and wheels differ by lasts from sample to sample (correlation %.2f), as where whole "
                      "counts hide where a wheel is, or a tracker smooths its poses: only samples %.2g s apart were "
                      "used",
                      next(*all), apart_s)
          : formatted("the truth's noise lasts from sample to sample (correlation %.2f), as where a tracker smooths "
                      "its poses or joints round them: only samples %.2g s apart were used",
                      next(*all), apart_s));
  return of_fewer;
}

}  // namespace

Result<LeastSquaresCalibration> calibrate_least_squares(const std::vector<Recording>& recordings,
                                                        const Vehicle& nominal, const LeastSquaresOptions& options,
                                                        const Progress& progress) {
  std::vector<Recording> measured = recordings;
  std::vector<std::string> said;
  bool all_are_computed = true;
  for (Recording& r : measured) {
    std::optional<std::string> computed = warning_of_computed_truth(r);
    all_are_computed = all_are_computed && computed;
    if (computed) said.push_back(std::move(*computed));
    if (std::optional<MeasuredRecording> corrections = without_carried_truth(r)) {
      said.push_back(std::move(corrections->said));
      r = std::move(corrections->recording);
    }
  }
  const Vehicle turned = options.fit_truth_mounting ? turned_as_driven(measured, nominal) : nominal;
  // A truth without noise has none that lasts.
  const bool is_white = all_are_computed || options.truth_is_white;
  const double smoothed_s = is_white ? 0.0 : smoothed_at_rest_for_s(measured, turned, options.by_commands);
  std::optional<Result<LeastSquaresCalibration>> smoothed =
      calibrated_beyond_smoothing(smoothed_s, measured, turned, options, progress);
  LeastSquaresOptions filter_is_looked_for = options;
  filter_is_looked_for.truth_is_unfiltered |= smoothed_s > 0.0;  // beyond what is smoothed at rest, just now
  Result<LeastSquaresCalibration> result =
      smoothed   ? *std::move(smoothed)
      : is_white ? calibrated_by_all(measured, turned, options, progress)
                 : calibrated_by_white_truth(measured, turned, filter_is_looked_for, progress);
  if (!result) return result;
  result->truth_smoothed_for_s = smoothed_s;
  if (const double count_m = largest_count_m(measured, turned); counts_are_a_long_way(count_m, result->noise))
    said.push_back(formatted("one count of the encoders is %.2g mm on the floor: of less than that they say nothing",
                             1e3 * count_m));
  result->warnings.insert(result->warnings.begin(), said.begin(), said.end());
  for (ParameterEstimate& p : result->parameters)
    if (column::of_key(p.name) == column::mounting_heading) p.nominal = nominal.truth.axle_T_tracked.heading_rad;
  return result;
}

}  // namespace odolab
