#include "core/calibration/least_squares.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/base/parallel.h"
#include "core/calibration/cannot_be_told.h"
#include "core/calibration/carried_truth.h"
#include "core/calibration/correlated_truth.h"
#include "core/calibration/first_guess.h"
#include "core/calibration/left_out.h"
#include "core/calibration/likelihood_fit.h"
#include "core/calibration/recording_fault.h"
#include "core/calibration/restamped.h"
#include "core/calibration/shape_guess.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kColumns = column::first_extra;

struct ColumnName {
  const char* key;
  const char* unit;
};
constexpr std::array<ColumnName, kColumns> kNames = {{{"wheel_radius_left_m", "m"},
                                                      {"wheel_radius_right_m", "m"},
                                                      {"wheelbase_m", "m"},
                                                      {"truth_mounting.x_m", "m"},
                                                      {"truth_mounting.y_m", "m"},
                                                      {"truth_mounting.heading_rad", "rad"},
                                                      {"truth_mounting.time_offset_s", "s"}}};
// What wheels and body err along the way together, per root metre: how much of it is whose is often hard to tell.
double along_in_all(const FittedNoise& noise) {
  return std::hypot(noise.wheel_m_per_sqrt_m / std::sqrt(2.0), noise.along_m_per_sqrt_m);
}

std::string text(const char* format, double a = 0.0, double b = 0.0) {
  char buffer[240];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

// Whether the robots hardly ever changed their speed while they drove. Without headings, a clock that is late by dt
// then looks like a tracked point that is v dt behind.
bool at_steady_speed(const std::vector<InnovationRun>& runs, const DifferentialDrive& drive) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const InnovationRun& run : runs)
    for (const DriveStep& step : drive_steps(run, drive)) {
      const double speed = 0.5 * (step.left_m + step.right_m) / step.duration_s;
      if (std::abs(speed) < 0.01) continue;
      n += 1.0;
      sum += speed;
      squares += speed * speed;
    }
  constexpr double kSteady = 0.3;
  return n < 2.0 || squares / n - sum * sum / (n * n) < kSteady * kSteady * sum * sum / (n * n);
}

// So far from each other that the likelihood may have another minimum in between.
bool far_apart(const DifferentialDrive& a, const DifferentialDrive& b) {
  constexpr double kNear = 0.1;
  return std::abs(std::log(a.wheelbase_m / b.wheelbase_m)) > kNear ||
         std::abs(std::log((a.wheel_radius_left_m + a.wheel_radius_right_m) /
                           (b.wheel_radius_left_m + b.wheel_radius_right_m))) > kNear;
}

// No vehicle's file is wrong by a factor of five.
bool is_beyond_belief(double ratio) {
  constexpr double kMost = 5.0;
  return !(ratio > 1.0 / kMost && ratio < kMost);
}

// For those who know nothing of clocks: the truth's stamps as they are by the vehicle's file.
std::vector<InnovationRun> by_the_wheels_clock(std::vector<InnovationRun> runs, double truth_late_s) {
  for (InnovationRun& run : runs)
    for (TruthSample& t : run.truth) t.time_s -= truth_late_s;
  return runs;
}

std::optional<TimeStretches> left_out_of(std::size_t recording, const LeastSquaresOptions& options) {
  if (recording >= options.left_out.size()) return std::nullopt;
  return options.left_out[recording];
}

// All truth samples that are there.
Result<LeastSquaresCalibration> calibrated_by_all(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                  const LeastSquaresOptions& options, const Progress& progress) {
  if (const auto other = other_than_differential_drive(nominal, "can be calibrated against a truth")) return *other;
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (const std::vector<std::string> problems = problems_in(*drive); !problems.empty())
    return Error{nominal.name, "", problems.front()};
  if (recordings.empty()) return Error{"recordings", "none", "one or more"};
  std::vector<InnovationRun> runs;
  std::vector<std::string> put_right;
  bool any_heading = false;
  std::vector<std::optional<Result<InnovationRun>>> read(recordings.size());
  parallel_for(static_cast<int>(recordings.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    read[r] = innovation_run(recordings[r], nominal, left_out_of(r, options));
  });
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    Result<InnovationRun>& run = *read[r];
    if (!run) return run.error();
    any_heading = any_heading || run->truth_has_heading;
    put_right.insert(put_right.end(), run->warnings.begin(), run->warnings.end());
    if (r < options.clocks.size()) put_clock_right(*run, options.clocks[r].rate, options.clocks[r].offset_s);
    runs.push_back(std::move(*run));
  }
  const Error stopped{"calibration", "stopped before its end", ""};
  for (const std::optional<Error>& fault : faults_in(recordings, nominal))
    if (fault) return *fault;
  const double late_s = nominal.truth.time_offset_s;
  std::vector<InnovationRun> moved;
  if (late_s != 0.0) moved = by_the_wheels_clock(runs, late_s);
  const std::vector<InnovationRun>& on_one_clock = late_s != 0.0 ? moved : runs;
  if (const std::string contradiction = contradiction_in(on_one_clock, *drive); !contradiction.empty())
    return Error{recordings.size() == 1 ? recordings[0].name : "the recordings", contradiction,
                 "wheels and truth of one robot, in the units that the columns are named after"};
  const FirstGuess guess = first_guess(on_one_clock, *drive);
  const std::vector<std::string> jumps = counter_jumps_in(runs);

  std::vector<int> active;
  if (options.fit_drive) active = {column::wheel_radius_left, column::wheel_radius_right, column::wheelbase};
  if (options.fit_truth_mounting) {
    active.push_back(column::mounting_x);
    active.push_back(column::mounting_y);
    if (any_heading) active.push_back(column::mounting_heading);
  }
  const bool clock_hides_in_place = !any_heading && at_steady_speed(runs, *drive);
  if (clock_hides_in_place) active.erase(std::remove(active.begin(), active.end(), column::mounting_x), active.end());
  FitParameters start{{*drive, nominal.truth, {0.005, 0.005, 0.02}},
                      std::vector<double>(options.one_truth_clock ? 1 : runs.size(), nominal.truth.time_offset_s)};
  for (std::size_t r = 0; r < options.clocks.size(); ++r) start.clock_s[r] = options.clocks[r].offset_s;
  if (options.fit_truth_clock && options.clocks.empty() && !clock_hides_in_place)
    for (int c = column::shared; c < start.size(); ++c) active.push_back(c);
  LikelihoodFit fit(std::move(runs), start);
  if (options.fit_drive && guess.trusted && far_apart(guess.drive, *drive)) fit.start_from(guess.drive);
  if (const auto shape = shape_guess(fit.runs(), *drive, nominal.truth)) {
    if (options.fit_drive) fit.start_from(shape->drive);
    if (options.fit_truth_mounting) fit.start_from(shape->tracked_m);
  }

  // FitParameters, noise and outliers in turns, each linearised where the last ended: three rounds suffice where
  // nothing is odd, since each depends little on the others.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const FittedNoise before = fit.now().shared.noise;
    fit.fit_parameters(active, 1.0, options.most_iterations);
    if (!goes_on(progress, (round + 0.5) / (kRounds + 1))) return stopped;
    fit.fit_noise(active);
    if (!goes_on(progress, (round + 1.0) / (kRounds + 1))) return stopped;
    const bool changed = fit.gate();
    const FittedNoise& now = fit.now().shared.noise;
    const double moved = std::max({std::abs(std::log(along_in_all(now) / along_in_all(before))),
                                   std::abs(std::log(now.truth_position_m / before.truth_position_m)),
                                   std::abs(std::log(now.truth_heading_rad / before.truth_heading_rad))});
    if (round > 0 && !changed && moved < 0.02) break;
  }

  // What these recordings determine, Eq. 11; the rest goes back to its nominal value and the fit is repeated without
  // priors.
  const int n = static_cast<int>(active.size());
  const auto information_of = [&](const LikelihoodFit::Sums& s) {
    MatrixXd a(n, n);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) a(r, c) = s.information(active[r], active[c]);
    return a;
  };
  std::vector<char> determined(start.size(), 0);
  MatrixXd posterior;
  const auto determine = [&] {
    fit.fit_parameters(active, 1.0, options.most_iterations);
    const MatrixXd information = information_of(fit.sums_now());
    posterior = (information + fit.information_held(active) + MatrixXd::Identity(n, n)).inverse();
    for (int k = 0; k < n; ++k) determined[active[k]] = std::sqrt(posterior(k, k)) < kDetermined;
  };
  const auto some_of_drive = [&] {
    return determined[column::wheel_radius_left] || determined[column::wheel_radius_right] ||
           determined[column::wheelbase];
  };
  determine();
  bool scale_is_open = false;  // while ratios show: a radius that stayed as it is would put its error on the others
  if (options.fit_drive && !(determined[column::wheel_radius_left] && determined[column::wheel_radius_right])) {
    fit.hold_mean_radius();
    determine();
    scale_is_open = some_of_drive();
  }
  std::vector<int> kept;
  for (int c : active)
    if (determined[c])
      kept.push_back(c);
    else
      fit.hold_at_nominal(c);
  fit.fit_parameters(kept, 0.0, options.most_iterations);
  if (!goes_on(progress, 1.0)) return stopped;

  LeastSquaresCalibration result;
  result.warnings = put_right;
  result.warnings.insert(result.warnings.end(), jumps.begin(), jumps.end());
  const InnovationModel& model = fit.now().shared;
  fit.correlations(result.correlation);
  const LikelihoodFit::Lasting lasting = fit.lasting_correlation();
  result.lasting_correlation = lasting.a_reading;
  result.correlation_after_1_s = lasting.a_second;
  constexpr int kBatches = 60;
  const LikelihoodFit::Sums final_sums = fit.sums(fit.now(), true, kBatches);
  result.innovations = final_sums.scalars;

  // Standard errors: what is held at its nominal value stays uncertain by its prior.
  MatrixXd precision = information_of(final_sums) + fit.information_held(active);
  for (int k = 0; k < n; ++k) precision(k, k) += determined[active[k]] ? 1e-12 : 1.0;
  MatrixXd covariance = precision.inverse();

  // Where the innovations are correlated, the scatter of the score says more than the model, Eq. 12. Under the null a
  // correlation scatters by 1 / sqrt(n): four of them and a tenth are beyond chance and not negligible.
  const double by_chance = 4.0 / std::sqrt(std::max(1.0, result.innovations / (any_heading ? 3.0 : 2.0)));
  const double largest =
      std::max({std::abs(result.correlation[0]), std::abs(result.correlation[1]), std::abs(result.correlation[2])});
  if (largest > std::max(0.1, by_chance)) {
    double most = 1.0;
    if (final_sums.batches >= kBatches / 2) {
      MatrixXd scatter(n, n);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) scatter(r, c) = final_sums.scatter(active[r], active[c]);
      const MatrixXd robust = covariance * scatter * covariance;
      VectorXd factor = VectorXd::Ones(n);
      for (int k = 0; k < n; ++k)
        if (determined[active[k]]) factor(k) = std::max(1.0, std::sqrt(robust(k, k) / covariance(k, k)));
      covariance = factor.asDiagonal() * covariance * factor.asDiagonal();
      most = factor.maxCoeff();
    }
    result.innovations_are_correlated = true;
    result.warnings.push_back(
        text("the innovations are correlated (%.2f from one to the next): there is something that these "
             "parameters do not describe; standard errors were enlarged, at most by a factor of %.1f",
             largest, most));
  }

  // As reported: the shared parameters, and the mean of the clocks weighted by their precision.
  MatrixXd reported = MatrixXd::Zero(kColumns, n);
  double weights = 0.0;
  for (int k = 0; k < n; ++k) {
    if (active[k] < column::shared) reported(active[k], k) = 1.0;
    if (active[k] >= column::shared && determined[active[k]])
      weights += reported(column::truth_clock, k) = 1.0 / covariance(k, k);
  }
  if (weights > 0.0) reported.row(column::truth_clock) /= weights;
  const MatrixXd reported_covariance = reported * covariance * reported.transpose();
  double clock_s = nominal.truth.time_offset_s, clock_scatter = 0.0;
  for (int k = 0; k < n; ++k)
    if (active[k] >= column::shared)
      clock_s +=
          reported(column::truth_clock, k) * (LikelihoodFit::value(fit.now(), active[k]) - nominal.truth.time_offset_s);
  std::vector<int> shown;
  for (int c = 0; c < kColumns; ++c) {
    if (!(c == column::truth_clock ? options.fit_truth_clock
          : c > column::wheelbase  ? options.fit_truth_mounting
                                   : options.fit_drive))
      continue;
    const auto at = std::find(active.begin(), active.end(), c);
    ParameterEstimate p;
    p.name = kNames[c].key;
    p.unit = kNames[c].unit;
    p.nominal = c == column::truth_clock ? nominal.truth.time_offset_s : LikelihoodFit::value(start, c);
    p.value = c == column::truth_clock ? clock_s : LikelihoodFit::value(fit.now(), c);
    p.determined = c == column::truth_clock ? weights > 0.0 : determined[c] != 0;
    if (c <= column::wheelbase && p.determined && is_beyond_belief(p.value / p.nominal))
      return Error{recordings.size() == 1 ? recordings[0].name : "the recordings",
                   p.name + text(" of %.3g m where the vehicle's file has %.3g m", p.value, p.nominal),
                   "wheels and truth of one robot, in the units that the columns are named after"};
    p.stderr_value = fit.prior(c);
    if (p.determined)
      p.stderr_value *= std::sqrt(reported_covariance(c, c));
    else if (at != active.end())
      p.stderr_value *= std::sqrt(posterior(at - active.begin(), at - active.begin()));
    if (p.determined) shown.push_back(c);
    result.parameters.push_back(p);
  }
  for (int a : shown)
    for (int b : shown) result.covariance.push_back(fit.prior(a) * fit.prior(b) * reported_covariance(a, b));
  for (std::size_t r = 0; r < fit.runs().size(); ++r) {
    result.time_offset_s.push_back(fit.now().of(static_cast<int>(r)).truth.time_offset_s);
    const int c = fit.now().clock_of(static_cast<int>(r));
    if (!determined[c]) continue;
    const auto k = std::find(active.begin(), active.end(), c) - active.begin();
    clock_scatter = std::max(
        clock_scatter, std::abs(result.time_offset_s.back() - clock_s) / (fit.prior(c) * std::sqrt(covariance(k, k))));
  }

  result.vehicle = nominal;
  result.vehicle.kind = model.drive;
  result.vehicle.truth = model.truth;
  result.vehicle.truth.time_offset_s = clock_s;
  result.noise = model.noise;
  if (!any_heading) result.noise.truth_heading_rad = 0.0;
  result.scale_is_open = scale_is_open;
  result.cannot_tell = what_cannot_be_told(determined, scale_is_open, active, fit.runs(), model.drive, any_heading);
  if (clock_hides_in_place)
    result.cannot_tell.push_back(
        "truth_mounting.x_m and time_offset_s: at a steady speed, and without headings, a late clock looks like a "
        "tracked point "
        "further behind; both stay as given. Change the speed on the way, or stop now and then");
  result.normalised_chi2 = final_sums.chi2 / std::max(1, final_sums.scalars);
  FitParameters as_nominal = start;
  as_nominal.shared.noise = model.noise;
  const LikelihoodFit::Sums nominal_sums = fit.sums(as_nominal, false);
  result.normalised_chi2_nominal = nominal_sums.chi2 / std::max(1, nominal_sums.scalars);
  const int samples = fit.truth_samples();
  int frozen = 0;
  for (const InnovationRun& run : fit.runs()) {
    frozen += run.frozen;
    result.outliers += static_cast<int>(std::count(run.set_aside.begin(), run.set_aside.end(), 1));
  }

  if (frozen > 0)
    result.warnings.push_back(std::to_string(frozen) +
                              " truth samples repeat themselves while the wheels turn and were left out");
  if (fit.restarts() > 0)
    result.warnings.push_back(
        "the truth contradicts the wheels for 20 samples or more at " + std::to_string(fit.restarts()) +
        (fit.restarts() == 1 ? " place; the fit starts anew behind it" : " places; the fit starts anew behind them"));
  if (result.outliers > 0.02 * samples)
    result.warnings.push_back(std::to_string(result.outliers) + " of " + std::to_string(samples) +
                              " truth samples contradict their neighbours and were set aside");
  if (clock_scatter > 5.0) {
    const auto [least, most] = std::minmax_element(result.time_offset_s.begin(), result.time_offset_s.end());
    result.warnings.push_back(
        text("the truth's clock differs between the recordings: from %.3f s to %.3f s", *least, *most));
  }
  for (const ParameterEstimate& p : result.parameters)
    if (p.determined && p.unit == "m" && p.name.rfind("wheel", 0) == 0 && std::abs(p.value / p.nominal - 1.0) > 0.1)
      result.warnings.push_back(p.name +
                                text(": %.0f %% away from its nominal value", 100.0 * (p.value / p.nominal - 1.0)));
  return result;
}

// Where the moments say that they are elsewhere than the fit has them; empty where not, or where a clock is shared.
std::vector<AlignedClock> moved_clocks(const std::vector<Recording>& recordings, const LeastSquaresCalibration& fit,
                                       const LeastSquaresOptions& options) {
  const auto* drive = std::get_if<DifferentialDrive>(&fit.vehicle.kind);
  if (!drive || fit.time_offset_s.size() != recordings.size() || options.one_truth_clock) return {};
  std::vector<InnovationRun> runs;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    Result<InnovationRun> run = innovation_run(recordings[r], fit.vehicle, left_out_of(r, options));
    if (!run) return {};
    runs.push_back(std::move(*run));
  }
  const auto model_of = [&](int run) {
    InnovationModel model{*drive, fit.vehicle.truth, fit.noise};
    model.truth.time_offset_s = fit.time_offset_s[static_cast<std::size_t>(run)];
    return model;
  };
  const std::vector<std::optional<AlignedClock>> found = aligned_clocks(runs, model_of);
  if (!worth_a_try(found)) return {};
  std::vector<AlignedClock> clocks;
  for (std::size_t r = 0; r < found.size(); ++r)
    clocks.push_back(found[r].value_or(AlignedClock{fit.time_offset_s[r], 0.0, 0.0}));
  return clocks;
}

// Of fewer samples of the truth, where its noise lasts from one to the next.
Result<LeastSquaresCalibration> calibrated_by_white_truth(const std::vector<Recording>& recordings,
                                                          const Vehicle& nominal, const LeastSquaresOptions& options,
                                                          const Progress& progress) {
  // A missing effect correlates innovations too, but less, or over as long as a manoeuvre lasts: then none that are
  // further apart are white.
  constexpr double kNext = 0.5, kLasting = 0.2, kOfManoeuvres = 0.5, kWhite = 0.06, kWhiter = 0.33;
  const auto next = [](const LeastSquaresCalibration& c) {
    return std::max({c.correlation[0], c.correlation[1], c.correlation[2]});
  };
  Result<LeastSquaresCalibration> all = calibrated_by_all(recordings, nominal, options, progress);
  const auto is_white = [&](const LeastSquaresCalibration& c) {
    return next(c) < kNext && c.lasting_correlation < kWhite;
  };
  if (!all || is_white(*all) || all->correlation_after_1_s > kOfManoeuvres) return all;
  // A base that follows its commands late correlates them as a tracker that smooths does, but not where it stands.
  if (const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind); options.by_commands && drive) {
    const std::optional<double> at_rest = correlation_at_rest(recordings, *drive);
    if (at_rest && *at_rest <= kLasting) return all;
  }
  // Clocks that run apart correlate them just so, and that is no noise.
  LeastSquaresOptions clocks_right = options;
  clocks_right.clocks = moved_clocks(recordings, *all, options);
  const bool clocks_are_off = !clocks_right.clocks.empty();
  if (clocks_are_off) {
    const auto put_right = calibrated_by_all(recordings, nominal, clocks_right, progress);
    if (put_right && is_white(*put_right)) return all;
  }
  constexpr std::array<double, 7> kApart_s = {0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0};
  const auto of_samples_apart = [&](double apart_s, const LeastSquaresOptions& with) {
    std::vector<Recording> thinned;
    for (const Recording& recording : recordings) thinned.push_back(with_truth_apart(recording, apart_s));
    return calibrated_by_all(thinned, nominal, with, {});
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
  of_fewer->warnings.push_back(
      text("the truth's noise lasts from sample to sample (correlation %.2f), as where a tracker smooths its poses or "
           "joints round them: only samples %.2g s apart were used",
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
  // A truth without noise has none that lasts.
  Result<LeastSquaresCalibration> result = all_are_computed
                                               ? calibrated_by_all(measured, nominal, options, progress)
                                               : calibrated_by_white_truth(measured, nominal, options, progress);
  if (result) result->warnings.insert(result->warnings.begin(), said.begin(), said.end());
  return result;
}

}  // namespace odolab
