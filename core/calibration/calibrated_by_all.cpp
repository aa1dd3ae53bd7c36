#include "core/calibration/calibrated_by_all.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/calibration/cannot_be_told.h"
#include "core/calibration/column_names.h"
#include "core/calibration/first_guess.h"
#include "core/calibration/left_out.h"
#include "core/calibration/likelihood_fit.h"
#include "core/calibration/miscounted_wheel.h"
#include "core/calibration/recording_fault.h"
#include "core/calibration/restamped.h"
#include "core/calibration/shape_guess.h"
#include "core/geometry/heading_range.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kColumnsOfAll = column::first_extra;

// What wheels and body err along the way together, per root metre: how much of it is whose is often hard to tell.
double along_in_all(const FittedNoise& noise) {
  return std::hypot(noise.wheel_m_per_sqrt_m / std::sqrt(2.0), noise.along_m_per_sqrt_m);
}

// Whether one of the robots turned by more than wheels slip and counts round to on a straight: of less these make
// nearly all, and what shows in turns alone would come out as small as they are large (errors in variables).
bool any_turns(const std::vector<InnovationRun>& runs, const DifferentialDrive& drive) {
  constexpr double kLeast_rad = 0.1;
  return std::any_of(runs.begin(), runs.end(),
                     [&](const InnovationRun& run) { return heading_range_rad(drive_steps(run, drive)) > kLeast_rad; });
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

// For those who know nothing of clocks and of how a tracked body is turned: stamps and headings as they are by the
// vehicle's file.
std::vector<InnovationRun> as_the_wheels_have_it(std::vector<InnovationRun> runs, const TruthMounting& mounting) {
  for (InnovationRun& run : runs)
    for (TruthSample& t : run.truth) {
      t.time_s -= mounting.time_offset_s;
      if (t.heading_rad) *t.heading_rad -= mounting.axle_T_tracked.heading_rad;
    }
  return runs;
}

struct ReadRuns {
  std::vector<InnovationRun> runs;
  std::vector<std::string> put_right;  // what was, in words
  bool any_heading = false;
};

Result<ReadRuns> read_runs(const std::vector<Recording>& recordings, const Vehicle& nominal,
                           const LeastSquaresOptions& options) {
  ReadRuns all;
  std::vector<std::optional<Result<InnovationRun>>> read(recordings.size());
  parallel_for(static_cast<int>(recordings.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    read[r] = innovation_run(recordings[r], nominal, options.left_out_of(r));
  });
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    Result<InnovationRun>& run = *read[r];
    if (!run) return run.error();
    all.any_heading = all.any_heading || run->truth_has_heading;
    all.put_right.insert(all.put_right.end(), run->warnings.begin(), run->warnings.end());
    if (r < options.clocks.size()) put_clock_right(*run, options.clocks[r].rate, options.clocks[r].offset_s);
    all.runs.push_back(std::move(*run));
  }
  for (const std::optional<Error>& fault : faults_in(recordings, nominal))
    if (fault) return *fault;
  return all;
}

// One fit, from where it begins to what is reported of it.
class FitOfAll {
 public:
  FitOfAll(ReadRuns read, const Vehicle& nominal, const LeastSquaresOptions& options)
      : nominal_(nominal),
        options_(options),
        drive_(std::get<DifferentialDrive>(nominal.kind)),
        any_heading_(read.any_heading),
        said_(std::move(read.put_right)),
        start_{{drive_, nominal.truth, {0.005, 0.005, 0.02}},
               std::vector<double>(options.one_truth_clock ? 1 : read.runs.size(), nominal.truth.time_offset_s)} {
    const std::vector<std::string> jumps = counter_jumps_in(read.runs);
    said_.insert(said_.end(), jumps.begin(), jumps.end());
    for (std::size_t r = 0; r < options.clocks.size(); ++r) start_.clock_s[r] = options.clocks[r].offset_s;
    for (int c = 0; c < start_.size(); ++c)
      if (is_asked_for(c) && may_show(c)) active_.push_back(c);
    determined_.assign(static_cast<std::size_t>(start_.size()), 0);
    fit_.emplace(std::move(read.runs), start_);
  }

  void begin_at(const FirstGuess& guess) {
    if (options_.fit_drive && guess.trusted && far_apart(guess.drive, drive_)) fit_->start_from(guess.drive);
    if (const auto shape = shape_guess(fit_->runs(), drive_, nominal_.truth)) {
      if (options_.fit_drive) fit_->start_from(shape->drive);
      if (options_.fit_truth_mounting) fit_->start_from(shape->tracked_m);
    }
  }

  // Parameters, noise and outliers in turns, each linearised where the last ended: three rounds suffice where nothing
  // is odd, since each depends little on the others. False where `progress` stops it.
  bool fit_in_rounds(const Progress& progress) {
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds; ++round) {
      const FittedNoise before = fit_->now().shared.noise;
      fit_->fit_parameters(active_, 1.0, options_.most_iterations);
      if (!goes_on(progress, (round + 0.5) / (kRounds + 1))) return false;
      fit_->fit_noise(active_);
      if (!goes_on(progress, (round + 1.0) / (kRounds + 1))) return false;
      const bool changed = fit_->gate();
      const FittedNoise& now = fit_->now().shared.noise;
      const double moved = std::max({std::abs(std::log(along_in_all(now) / along_in_all(before))),
                                     std::abs(std::log(now.truth_position_m / before.truth_position_m)),
                                     std::abs(std::log(now.truth_heading_rad / before.truth_heading_rad))});
      if (round > 0 && !changed && moved < 0.02) break;
    }
    return true;
  }

  // What these recordings determine, Eq. 11; the rest goes back to its nominal value and the fit is repeated without
  // priors.
  void keep_what_shows() {
    determine();
    if (clock_hides_in_place()) {
      clock_hides_ = true;
      fit_->keep_priors_of_clocks();
      determine();
    }
    if (options_.fit_drive && !(determined_[column::wheel_radius_left] && determined_[column::wheel_radius_right])) {
      // A radius that stayed as it is, while ratios show, would put its error on the others.
      fit_->hold_mean_radius();
      determine();
      scale_is_open_ = determined_[column::wheel_radius_left] || determined_[column::wheel_radius_right] ||
                       determined_[column::wheelbase];
    }
    std::vector<int> kept;
    for (int c : active_)
      if (determined_[c])
        kept.push_back(c);
      else
        fit_->hold_at_nominal(c);
    fit_->fit_parameters(kept, 0.0, options_.most_iterations);
  }

  // An error where a radius or the wheelbase is beyond belief; `named`: the recordings, in words.
  Result<LeastSquaresCalibration> reported(const std::string& named) const {
    LeastSquaresCalibration result;
    result.warnings = said_;
    fit_->correlations(result.correlation);
    const LikelihoodFit::Lasting lasting = fit_->lasting_correlation();
    result.lasting_correlation = lasting.a_reading;
    result.correlation_after_1_s = lasting.a_second;
    const LikelihoodFit::Sums sums = fit_->sums(fit_->now(), true, kBatches);
    result.innovations = sums.scalars;
    const MatrixXd covariance = covariance_by(sums, result);
    const Clock clock = clock_by(covariance);
    if (const std::optional<Error> unbelievable = put_parameters(covariance, clock, named, result))
      return *unbelievable;

    const InnovationModel& model = fit_->now().shared;
    result.vehicle = nominal_;
    result.vehicle.kind = model.drive;
    result.vehicle.truth = model.truth;
    result.vehicle.truth.time_offset_s = clock.offset_s;
    result.noise = model.noise;
    if (!any_heading_) result.noise.truth_heading_rad = 0.0;
    result.scale_is_open = scale_is_open_;
    result.cannot_tell =
        what_cannot_be_told(determined_, scale_is_open_, active_, fit_->runs(), model.drive, any_heading_);
    if (clock_hides_)
      result.cannot_tell.push_back(
          "truth_mounting.x_m and time_offset_s: at a steady speed, and without headings, a late clock looks like a "
          "tracked point further behind; only both together show. Change the speed on the way, or stop now and then");
    result.normalised_chi2 = sums.chi2 / std::max(1, sums.scalars);
    result.minus_two_log_likelihood = sums.chi2 + sums.log_determinant;
    FitParameters as_nominal = start_;
    as_nominal.shared.noise = model.noise;
    const LikelihoodFit::Sums nominal_sums = fit_->sums(as_nominal, false);
    result.normalised_chi2_nominal = nominal_sums.chi2 / std::max(1, nominal_sums.scalars);
    warn_of_truth(result);
    warn_of_values(clock, result);
    return result;
  }

 private:
  static constexpr int kBatches = 60;

  // The mean of the clocks of all recordings, weighted by their precision.
  struct Clock {
    double offset_s = 0.0;
    double scatter = 0.0;  // the largest of a recording's, in standard errors
    bool is_determined = false;
    MatrixXd reported;  // each parameter as reported, by what is active
  };

  bool is_asked_for(int c) const {
    if (c <= column::wheelbase) return options_.fit_drive;
    if (c < column::shared) return options_.fit_truth_mounting;
    return options_.fit_truth_clock;
  }
  bool may_show(int c) const {
    if (c == column::mounting_heading) return any_heading_;
    return c < column::shared || options_.clocks.empty();
  }

  int active_count() const { return static_cast<int>(active_.size()); }

  MatrixXd of_active(const MatrixXd& all) const { return all(active_, active_); }

  void determine() {
    const int n = active_count();
    fit_->fit_parameters(active_, 1.0, options_.most_iterations);
    posterior_ = (of_active(fit_->sums_now().information) + fit_->information_held(active_) + MatrixXd::Identity(n, n))
                     .inverse();
    const bool turns = any_turns(fit_->runs(), fit_->now().shared.drive);
    for (int k = 0; k < n; ++k) {
      const bool shows_in_turns =
          active_[k] == column::wheelbase || active_[k] == column::mounting_x || active_[k] == column::mounting_y;
      if (shows_in_turns && !turns) posterior_(k, k) = 1.0;  // its prior's
      const bool hides = clock_hides_ && (active_[k] == column::mounting_x || active_[k] >= column::shared);
      determined_[active_[k]] = hides || std::sqrt(posterior_(k, k)) < kDetermined;
    }
  }

  // Whether the tracked point's place shows to those alone who know the clock, as without headings at a steady speed v:
  // a truth that is late by dt then looks like a point that is v dt behind. What little the posterior knows of such a
  // clock is by the jitter of counts, and wrong by up to six times as much.
  bool clock_hides_in_place() const {
    constexpr double kMost = 0.25;      // of the place's variance, to those
    constexpr double kByMotion = 0.03;  // a clock that starts and stops tell: 6 ms
    const auto x = std::find(active_.begin(), active_.end(), column::mounting_x) - active_.begin();
    if (any_heading_ || x == active_count()) return false;
    const VectorXd clocks = of_clocks();
    if ((clocks.array() * posterior_.diagonal().array()).maxCoeff() < kByMotion * kByMotion) return false;
    const VectorXd with_clocks = posterior_ * clocks;
    const double by_itself = posterior_(x, x),
                 by_the_clock = by_itself - with_clocks(x) * with_clocks(x) / clocks.dot(with_clocks);
    return by_the_clock < std::min(kDetermined * kDetermined, kMost * by_itself);
  }

  // 1 for each clock.
  VectorXd of_clocks() const {
    VectorXd clocks = VectorXd::Zero(active_count());
    for (int k = 0; k < active_count(); ++k) clocks(k) = active_[k] >= column::shared;
    return clocks;
  }

  // Of what is active; what is held at its nominal value stays uncertain by its prior. Where the innovations are
  // correlated, the scatter of the score says more than the model, Eq. 12, and `result` gets a warning. Under the null
  // a correlation scatters by 1 / sqrt(n): four of them and a tenth are beyond chance and not negligible.
  MatrixXd covariance_by(const LikelihoodFit::Sums& sums, LeastSquaresCalibration& result) const {
    const int n = active_count();
    MatrixXd precision = of_active(sums.information) + fit_->information_held(active_);
    for (int k = 0; k < n; ++k) precision(k, k) += determined_[active_[k]] ? 1e-12 : 1.0;
    if (fit_->leaves_headings_open()) precision = fit_->as_it_falls(active_, precision);
    MatrixXd covariance = precision.inverse();
    if (clock_hides_) {  // place and clocks are known as well as clocks are
      const VectorXd clocks = of_clocks(), with_clocks = covariance * clocks;
      VectorXd by_a_clock = with_clocks * (clocks.sum() / clocks.dot(with_clocks));
      for (int k = 0; k < n; ++k)
        if (active_[k] < column::shared && active_[k] != column::mounting_x) by_a_clock(k) = 0.0;
      covariance += by_a_clock * by_a_clock.transpose();
    }
    const double by_chance = 4.0 / std::sqrt(std::max(1.0, result.innovations / (any_heading_ ? 3.0 : 2.0)));
    const double largest =
        std::max({std::abs(result.correlation[0]), std::abs(result.correlation[1]), std::abs(result.correlation[2])});
    if (largest <= std::max(0.1, by_chance)) return covariance;
    VectorXd factor = VectorXd::Ones(n);
    if (sums.batches >= kBatches / 2) {
      const MatrixXd robust = covariance * of_active(sums.scatter) * covariance;
      for (int k = 0; k < n; ++k)
        if (determined_[active_[k]]) factor(k) = std::max(1.0, std::sqrt(robust(k, k) / covariance(k, k)));
    }
    result.innovations_are_correlated = true;
    result.of_misfit.push_back(
        formatted("the innovations are correlated (%.2f from one to the next): noise that lasts, or something that "
                  "these parameters do not describe; standard errors were enlarged, at most by a factor of %.1f",
                  largest, n > 0 ? factor.maxCoeff() : 1.0));
    return factor.asDiagonal() * covariance * factor.asDiagonal();
  }

  Clock clock_by(const MatrixXd& covariance) const {
    const int n = active_count();
    Clock clock;
    clock.reported = MatrixXd::Zero(kColumnsOfAll, n);
    double weights = 0.0;
    for (int k = 0; k < n; ++k) {
      if (active_[k] < column::shared) clock.reported(active_[k], k) = 1.0;
      if (active_[k] >= column::shared && determined_[active_[k]])
        weights += clock.reported(column::truth_clock, k) = 1.0 / covariance(k, k);
    }
    clock.is_determined = weights > 0.0;
    if (clock.is_determined) clock.reported.row(column::truth_clock) /= weights;
    clock.offset_s = nominal_.truth.time_offset_s;
    for (int k = 0; k < n; ++k)
      if (active_[k] >= column::shared)
        clock.offset_s += clock.reported(column::truth_clock, k) *
                          (LikelihoodFit::value(fit_->now(), active_[k]) - nominal_.truth.time_offset_s);
    for (int k = 0; k < n; ++k) {
      const int c = active_[k];
      if (c < column::shared || !determined_[c]) continue;
      const double off_s = LikelihoodFit::value(fit_->now(), c) - clock.offset_s;
      clock.scatter = std::max(clock.scatter, std::abs(off_s) / (fit_->prior(c) * std::sqrt(covariance(k, k))));
    }
    return clock;
  }

  std::optional<Error> put_parameters(const MatrixXd& covariance, const Clock& clock, const std::string& named,
                                      LeastSquaresCalibration& result) const {
    const MatrixXd of_reported = clock.reported * covariance * clock.reported.transpose();
    std::vector<int> shown;
    for (int c = 0; c < kColumnsOfAll; ++c) {
      if (!is_asked_for(c)) continue;
      const bool is_clock = c == column::truth_clock;
      const auto at = std::find(active_.begin(), active_.end(), c);
      ParameterEstimate p;
      p.name = column::names[c].key;
      p.unit = column::names[c].unit;
      p.nominal = is_clock ? nominal_.truth.time_offset_s : LikelihoodFit::value(start_, c);
      p.value = is_clock ? clock.offset_s : LikelihoodFit::value(fit_->now(), c);
      p.determined = is_clock ? clock.is_determined : determined_[c] != 0;
      if (c <= column::wheelbase && p.determined && is_beyond_belief(p.value / p.nominal))
        return Error{named, p.name + formatted(" of %.3g m where the vehicle's file has %.3g m", p.value, p.nominal),
                     "wheels and truth of one robot, in the units that the columns are named after"};
      p.stderr_value = fit_->prior(c);
      if (p.determined)
        p.stderr_value *= std::sqrt(of_reported(c, c));
      else if (at != active_.end())
        p.stderr_value *= std::sqrt(posterior_(at - active_.begin(), at - active_.begin()));
      if (p.determined) shown.push_back(c);
      result.parameters.push_back(p);
    }
    for (int a : shown)
      for (int b : shown) result.covariance.push_back(fit_->prior(a) * fit_->prior(b) * of_reported(a, b));
    for (std::size_t r = 0; r < fit_->runs().size(); ++r)
      result.time_offset_s.push_back(fit_->now().of(static_cast<int>(r)).truth.time_offset_s);
    return std::nullopt;
  }

  void warn_of_truth(LeastSquaresCalibration& result) const {
    const int samples = fit_->truth_samples();
    int frozen = 0;
    for (const InnovationRun& run : fit_->runs()) {
      frozen += run.frozen;
      result.outliers += static_cast<int>(std::count(run.set_aside.begin(), run.set_aside.end(), 1));
    }
    const std::string of_outliers = std::to_string(result.outliers) + " of " + std::to_string(samples) +
                                    " truth samples contradict their neighbours and were set aside";
    if (frozen > 0)
      result.warnings.push_back(std::to_string(frozen) +
                                " truth samples repeat themselves while the wheels turn and were left out");
    if (fit_->restarts() > 0)
      result.warnings.push_back("the truth contradicts the wheels for 20 samples or more at " +
                                std::to_string(fit_->restarts()) +
                                (fit_->restarts() == 1 ? " place; the fit starts anew behind it"
                                                       : " places; the fit starts anew behind them"));
    if (result.outliers > 0.02 * samples)
      result.of_misfit.push_back(of_outliers);
    else if (result.outliers > 0)
      result.warnings.push_back(of_outliers + ": " + where_outliers_are());
  }

  // The first few of each recording.
  std::string where_outliers_are() const {
    constexpr std::size_t kSaid = 3;
    std::string said;
    for (const InnovationRun& run : fit_->runs()) {
      std::vector<double> at_s;
      for (std::size_t i = 0; i < run.truth.size(); ++i)
        if (run.set_aside[i] == 1) at_s.push_back(run.truth[i].time_s);
      if (at_s.empty()) continue;
      said += (said.empty() ? "" : "; ") + run.name + " at";
      for (std::size_t k = 0; k < std::min(kSaid, at_s.size()); ++k) said += formatted(k ? ", %.2f" : " %.2f", at_s[k]);
      said += " s";
      if (at_s.size() > kSaid) said += formatted(" and %d more", static_cast<int>(at_s.size() - kSaid));
    }
    return said;
  }

  // No length of it is near what the file says.
  static void warn_of_another_vehicle(LeastSquaresCalibration& result) {
    constexpr double kOff = 0.25;
    int lengths = 0;
    for (const ParameterEstimate& p : result.parameters) {
      if (!p.determined || p.unit != "m" || p.name.rfind("wheel", 0) != 0) continue;
      if (std::abs(p.value / p.nominal - 1.0) < kOff) return;
      ++lengths;
    }
    if (lengths == 3)
      result.warnings.push_back(
          "neither wheel nor the wheelbase is near what the vehicle's file has: is it another vehicle's? What comes "
          "once per turn of a wheel is judged by the counts per turn that it states");
  }

  static void warn_of_values(const Clock& clock, LeastSquaresCalibration& result) {
    if (clock.scatter > 5.0) {
      const auto [least, most] = std::minmax_element(result.time_offset_s.begin(), result.time_offset_s.end());
      result.warnings.push_back(
          formatted("the truth's clock differs between the recordings: from %.3f s to %.3f s", *least, *most));
    }
    const std::vector<MiscountedWheel> miscounted = miscounted_wheels(result);
    double largest = 0.0, smallest = 1e300;  // radius by that of the file
    for (const ParameterEstimate& p : result.parameters) {
      if (!p.determined || p.unit != "m" || p.name.rfind("wheel", 0) != 0) continue;
      const double times = p.value / p.nominal;
      if (p.name.rfind("wheel_radius", 0) == 0)
        largest = std::max(largest, times), smallest = std::min(smallest, times);
      if (std::abs(times - 1.0) <= 0.1) continue;
      std::string warning = p.name + formatted(": %.0f %% away from its nominal value", 100.0 * (times - 1.0));
      for (const MiscountedWheel& w : miscounted)
        if (w.radius == p.name) warning += ": " + counts_in_words(w);
      result.warnings.push_back(warning);
    }
    warn_of_another_vehicle(result);
    // No two wheels are made twice too large.
    constexpr double kAlike = 0.03;
    for (const double times : {2.0, 4.0, 0.5, 0.25})
      if (std::abs(largest / times - 1.0) < kAlike && std::abs(smallest / times - 1.0) < kAlike)
        result.warnings.push_back(
            formatted("both wheels seem %.2g times as large as the vehicle's file has them: %sits "
                      "encoder_counts_per_revolution may be %s times too %s",
                      times, times == 0.5 ? "diameters in place of radii? Or " : "",
                      times == 2.0 || times == 0.5 ? "two" : "four", times > 1.0 ? "large" : "small"));
  }

  const Vehicle& nominal_;
  const LeastSquaresOptions& options_;
  DifferentialDrive drive_;  // as given
  bool any_heading_;
  std::vector<std::string> said_;
  FitParameters start_;
  std::vector<int> active_;  // columns that are fitted
  std::optional<LikelihoodFit> fit_;
  std::vector<char> determined_;  // of each column
  MatrixXd posterior_;
  bool scale_is_open_ = false, clock_hides_ = false;
};

}  // namespace

Result<LeastSquaresCalibration> calibrated_by_all(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                  const LeastSquaresOptions& options, const Progress& progress) {
  if (const auto other = other_than_differential_drive(nominal, "can be calibrated against a truth")) return *other;
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (const std::vector<std::string> problems = problems_in(*drive); !problems.empty())
    return Error{nominal.name, "", problems.front()};
  if (recordings.empty()) return Error{"recordings", "none", "one or more"};
  const std::string named = recordings.size() == 1 ? recordings[0].name : "the recordings";
  Result<ReadRuns> read = read_runs(recordings, nominal, options);
  if (!read) return read.error();
  std::vector<InnovationRun> moved;
  if (nominal.truth.time_offset_s != 0.0 || nominal.truth.axle_T_tracked.heading_rad != 0.0)
    moved = as_the_wheels_have_it(read->runs, nominal.truth);
  const std::vector<InnovationRun>& as_wheels_have_it = moved.empty() ? read->runs : moved;
  if (const Contradiction contradiction = contradiction_in(as_wheels_have_it, *drive); !contradiction.found.empty())
    return Error{named, contradiction.found, contradiction.expected};
  const FirstGuess guess = first_guess(as_wheels_have_it, *drive);

  FitOfAll fit(std::move(*read), nominal, options);
  fit.begin_at(guess);
  const Error stopped{"calibration", "stopped before its end", ""};
  if (!fit.fit_in_rounds(progress)) return stopped;
  fit.keep_what_shows();
  if (!goes_on(progress, 1.0)) return stopped;
  return fit.reported(named);
}

}  // namespace odolab
