#include "core/calibration/least_squares.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/base/parallel.h"
#include "core/calibration/first_guess.h"
#include "core/calibration/minimise.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kColumns = column::first_extra;
constexpr int kShared = column::truth_clock;  // columns that all recordings share; then a clock for each recording
constexpr double kGate = 30.0;  // squared size of an innovation; 1.4e-6 of normal ones of three channels are larger
constexpr double kDetermined = 0.1;  // share of its prior that a determined parameter's standard error stays below
constexpr int kNoiseSamples = 6000;  // truth samples that the noise is fitted to
constexpr int kNoiseStretch = 500;   // in stretches of this many

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

// All parameters: what the recordings share, and the clock of each.
struct Parameters {
  InnovationModel shared;
  std::vector<double> clock_s;  // one, or one for each recording

  int size() const { return kShared + static_cast<int>(clock_s.size()); }
  int clock_of(int recording) const { return kShared + (clock_s.size() == 1 ? 0 : recording); }
  InnovationModel of(int recording) const {
    InnovationModel model = shared;
    model.truth.time_offset_s = clock_s[clock_of(recording) - kShared];
    return model;
  }
};

double& entry(Parameters& parameters, int c) {
  InnovationModel& model = parameters.shared;
  switch (c) {
    case column::wheel_radius_left:
      return model.drive.wheel_radius_left_m;
    case column::wheel_radius_right:
      return model.drive.wheel_radius_right_m;
    case column::wheelbase:
      return model.drive.wheelbase_m;
    case column::mounting_x:
      return model.truth.axle_T_tracked.x_m;
    case column::mounting_y:
      return model.truth.axle_T_tracked.y_m;
    case column::mounting_heading:
      return model.truth.axle_T_tracked.heading_rad;
    default:
      return parameters.clock_s[c - kShared];
  }
}

// How far from its nominal value each parameter may be expected: a standard deviation in its own unit.
std::vector<double> prior_sizes(const Parameters& nominal) {
  const DifferentialDrive& drive = nominal.shared.drive;
  std::vector<double> sizes = {
      0.1 * drive.wheel_radius_left_m, 0.1 * drive.wheel_radius_right_m, 0.1 * drive.wheelbase_m, 0.2, 0.2, 0.3};
  sizes.resize(nominal.size(), 0.2);
  return sizes;
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

// The whole likelihood of all runs, with the state of the fit.
class Fit {
 public:
  Fit(std::vector<InnovationRun> runs, const Parameters& nominal)
      : runs_(std::move(runs)), nominal_(nominal), now_(nominal), prior_(prior_sizes(nominal)) {}

  // Begins elsewhere than at the nominal values; the priors stay where they are.
  void start_from(const DifferentialDrive& drive) { now_.shared.drive = drive; }

  struct Sums {
    double chi2 = 0.0;  // without the prior
    double log_determinant = 0.0;
    int scalars = 0;
    MatrixXd information;  // in units of the prior sizes
    VectorXd score;
    MatrixXd scatter;  // of the score over batches
    int batches = 0;
  };

  // `batches` above 0: also the scatter of the score over about so many batches.
  Sums sums(const Parameters& parameters, bool derivatives, int batches = 0) const {
    FilterOptions options;
    options.derivatives = derivatives;
    if (batches > 0) options.batch = std::max(1, truth_samples() / batches);
    const int n = static_cast<int>(runs_.size());
    std::vector<InnovationSums> of_run(n);
    each(n, [&](int r) {
      const InnovationModel model = parameters.of(r);
      of_run[r] = filtered(runs_[r], summed_up(runs_[r], model), model, options);
    });
    Sums total = none();
    for (int r = 0; r < n; ++r) add(total, r, of_run[r]);
    return total;
  }

  // On all cores where that is worth starting threads for.
  void each(int count, const std::function<void(int)>& work) const {
    constexpr int kWorthThreads = 5000;
    if (truth_samples() > kWorthThreads)
      parallel_for(count, work);
    else
      for (int i = 0; i < count; ++i) work(i);
  }

  // Levenberg and Marquardt on sum nu' S^-1 nu plus the prior of the active parameters; `weight` 0 leaves the prior
  // out.
  void fit_parameters(const std::vector<int>& active, double weight, int most_iterations) {
    const auto objective = [&](const Sums& s, const Parameters& at) { return s.chi2 + weight * prior_of(at, active); };
    Sums now = sums(now_, true);
    double value = objective(now, now_);
    double damping = 1e-6;
    const int n = static_cast<int>(active.size());
    for (int i = 0; i < most_iterations; ++i) {
      MatrixXd a(n, n);
      VectorXd g(n);
      for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) a(r, c) = now.information(active[r], active[c]);
        a(r, r) += weight;
        g(r) = now.score(active[r]) - weight * deviation(now_, active[r]);
      }
      bool accepted = false;
      double size = 0.0;
      for (int attempt = 0; attempt < 8 && !accepted; ++attempt) {
        MatrixXd damped = a;
        for (int r = 0; r < n; ++r) damped(r, r) *= 1.0 + damping;
        const VectorXd step = damped.ldlt().solve(g);
        size = step.dot(a * step);
        Parameters candidate = now_;
        for (int r = 0; r < n; ++r) entry(candidate, active[r]) += step(r) * prior_[active[r]];
        if (problems_in(candidate.shared.drive).empty()) {
          const Sums next = sums(candidate, true);
          const double next_value = objective(next, candidate);
          if (std::isfinite(next_value) && next_value <= value + 1e-9 * std::abs(value)) {
            now_ = candidate;
            now = next;
            value = next_value;
            accepted = true;
            damping = std::max(damping * 0.1, 1e-9);
            break;
          }
        }
        if (size < 1e-6) break;
        damping = std::max(damping * 10.0, 1e-4) * 3.0;
      }
      if (!accepted || size < 1e-6) break;  // a thousandth of a standard deviation
    }
  }

  // Maximum likelihood of the noise sizes with the parameters held. With few innovations the freedom that the
  // parameters took is counted too (restricted likelihood, Patterson and Thompson 1971), so that the noise is not
  // fitted too small.
  void fit_noise(const std::vector<int>& active, double first_stride) {
    std::vector<SummedRun> summed;
    bool any_heading = false;
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      summed.push_back(summed_up(runs_[r], now_.of(r)));
      any_heading = any_heading || runs_[r].truth_has_heading;
    }
    const std::vector<Stretch> stretches = noise_stretches();
    const bool restricted = truth_samples() < 1000;
    const auto noise_of = [&](const std::vector<double>& logs) {
      return FittedNoise{std::exp(logs[0]), std::exp(logs[1]),
                         any_heading ? std::exp(logs[2]) : now_.shared.noise.truth_heading_rad};
    };
    const auto objective = [&](const std::vector<double>& logs) {
      std::vector<InnovationSums> of_stretch(stretches.size());
      each(static_cast<int>(stretches.size()), [&](int i) {
        const Stretch& s = stretches[i];
        InnovationModel model = now_.of(s.run);
        model.noise = noise_of(logs);
        FilterOptions options;
        options.derivatives = restricted;
        options.first = s.first;
        options.last = s.last;
        of_stretch[i] = filtered(runs_[s.run], summed[s.run], model, options);
      });
      Sums total = none();
      for (std::size_t i = 0; i < stretches.size(); ++i) add(total, stretches[i].run, of_stretch[i]);
      double value = total.chi2 + total.log_determinant;
      if (restricted) {
        MatrixXd a(active.size(), active.size());
        for (std::size_t r = 0; r < active.size(); ++r)
          for (std::size_t c = 0; c < active.size(); ++c) a(r, c) = total.information(active[r], active[c]) + (r == c);
        value += a.ldlt().vectorD().array().log().sum();
      }
      // Very mild priors keep a size that the recordings say nothing about finite: a factor of ten either way.
      const double usual[3] = {0.003, 0.002, 0.005};
      for (std::size_t k = 0; k < logs.size(); ++k) value += std::pow((logs[k] - std::log(usual[k])) / 2.3, 2);
      return value;
    };
    FittedNoise& noise = now_.shared.noise;
    std::vector<double> logs = {std::log(noise.wheel_m_per_sqrt_m), std::log(noise.truth_position_m)};
    if (any_heading) logs.push_back(std::log(noise.truth_heading_rad));
    noise = noise_of(minimised(objective, logs, first_stride, 0.003, 150));
  }

  // Sets samples aside by the gate. True where that changed any.
  bool gate() {
    bool changed = false;
    restarts_ = 0;
    FilterOptions options;
    options.derivatives = false;
    options.gate = kGate;
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      const InnovationModel model = now_.of(r);
      InnovationSums s = filtered(runs_[r], summed_up(runs_[r], model), model, options);
      changed = changed || s.set_aside != runs_[r].set_aside;
      restarts_ += s.restarts;
      runs_[r].set_aside = std::move(s.set_aside);
    }
    return changed;
  }

  // Lag-one correlation of the whitened innovations of x, y and heading.
  void correlations(double* out) const {
    double product[3] = {}, square[3] = {};
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      bool has_before = false;
      double before[3] = {};
      FilterOptions options;
      options.derivatives = false;
      options.on_innovation = [&](const Innovation& i) {
        for (int k = 0; k < i.size; ++k) {
          if (has_before) product[k] += before[k] * i.white[k];
          square[k] += i.white[k] * i.white[k];
          before[k] = i.white[k];
        }
        has_before = true;
      };
      const InnovationModel model = now_.of(r);
      filtered(runs_[r], summed_up(runs_[r], model), model, options);
    }
    for (int k = 0; k < 3; ++k) out[k] = square[k] > 0.0 ? product[k] / square[k] : 0.0;
  }

  void hold_at_nominal(int c) { entry(now_, c) = value(nominal_, c); }
  static double value(Parameters parameters, int c) { return entry(parameters, c); }
  double deviation(const Parameters& at, int c) const { return (value(at, c) - value(nominal_, c)) / prior_[c]; }
  const Parameters& now() const { return now_; }
  const std::vector<InnovationRun>& runs() const { return runs_; }
  double prior(int c) const { return prior_[c]; }
  int restarts() const { return restarts_; }
  int truth_samples() const {
    int samples = 0;
    for (const InnovationRun& run : runs_) samples += static_cast<int>(run.truth.size());
    return samples;
  }

 private:
  struct Stretch {
    int run, first, last;
  };

  Sums none() const {
    const int n = now_.size();
    Sums zero;
    zero.information = zero.scatter = MatrixXd::Zero(n, n);
    zero.score = VectorXd::Zero(n);
    return zero;
  }

  void add(Sums& total, int recording, const InnovationSums& s) const {
    total.chi2 += s.chi2;
    total.log_determinant += s.log_determinant;
    total.scalars += s.scalars;
    if (s.score.empty()) return;
    std::array<int, kColumns> at;
    for (int c = 0; c < kColumns; ++c) at[c] = c < kShared ? c : now_.clock_of(recording);
    for (int r = 0; r < kColumns; ++r) {
      total.score(at[r]) += prior_[at[r]] * s.score[r];
      for (int c = 0; c < kColumns; ++c) {
        const double scale = prior_[at[r]] * prior_[at[c]];
        total.information(at[r], at[c]) += scale * s.information[r * kColumns + c];
        for (const std::vector<double>& g : s.batch_scores) total.scatter(at[r], at[c]) += scale * g[r] * g[c];
      }
    }
    total.batches += static_cast<int>(s.batch_scores.size());
  }

  double prior_of(const Parameters& at, const std::vector<int>& active) const {
    double sum = 0.0;
    for (int c : active) sum += deviation(at, c) * deviation(at, c);
    return sum;
  }

  // All truth, or stretches spread evenly where there is more than the noise needs.
  std::vector<Stretch> noise_stretches() const {
    const int every = std::max(1, (truth_samples() + kNoiseSamples - 1) / kNoiseSamples);
    std::vector<Stretch> stretches;
    int number = 0;
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      const int n = static_cast<int>(runs_[r].truth.size());
      if (every == 1) {
        stretches.push_back({r, 0, n});
        continue;
      }
      for (int first = 0; first + 1 < n; first += kNoiseStretch, ++number)
        if (number % every == 0) stretches.push_back({r, first, std::min(n, first + kNoiseStretch)});
    }
    return stretches;
  }

  std::vector<InnovationRun> runs_;
  Parameters nominal_;
  Parameters now_;
  std::vector<double> prior_;
  int restarts_ = 0;
};

// What the robot did, for the sentences on what it did not do.
struct Driven {
  double travel_m = 0.0;  // of the centre, forwards and backwards alike
  double turn_rad = 0.0;  // left and right alike
};

Driven driven_in(const std::vector<InnovationRun>& runs, const DifferentialDrive& drive) {
  Driven driven;
  for (const InnovationRun& run : runs)
    for (const DriveStep& step : drive_steps(run, drive)) {
      driven.travel_m += 0.5 * std::abs(step.left_m + step.right_m);
      driven.turn_rad += std::abs(step.turn_rad);
    }
  return driven;
}

std::vector<std::string> what_cannot_be_told(const std::vector<char>& determined, const std::vector<int>& active,
                                             const MatrixXd& information, const Driven& driven, bool any_heading) {
  std::vector<std::string> sentences;
  const auto open = [&](int c) { return std::find(active.begin(), active.end(), c) != active.end() && !determined[c]; };
  bool some_clock_is_open = false;
  for (int c : active) some_clock_is_open = some_clock_is_open || (c >= kShared && !determined[c]);
  const bool left = open(column::wheel_radius_left), right = open(column::wheel_radius_right),
             base = open(column::wheelbase);
  // The direction in the space of radii and wheelbase along which all of them grow together.
  bool scale_is_open = false;
  if (left && right && base) {
    VectorXd together = VectorXd::Zero(information.rows());
    for (std::size_t k = 0; k < active.size(); ++k)
      if (active[k] <= column::wheelbase) together(static_cast<Eigen::Index>(k)) = 1.0;
    scale_is_open = together.dot(information * together) < 1.0 / (kDetermined * kDetermined);
  }
  const std::string so_far = text(" (here: %.1f m of travel, %.1f rad of turning)", driven.travel_m, driven.turn_rad);
  if (scale_is_open)
    sentences.push_back("wheel radii and wheelbase: only their ratios show here, not the scale" + so_far +
                        "; drive a straight of a few metres");
  else if (left || right)
    sentences.push_back(std::string(left && right ? "wheel_radius_left_m and wheel_radius_right_m"
                                    : left        ? "wheel_radius_left_m"
                                                  : "wheel_radius_right_m") +
                        ": too little travel against the truth's noise" + so_far +
                        "; drive a straight of a few metres");
  if (base && !scale_is_open)
    sentences.push_back("wheelbase_m: the robot hardly turned" + so_far +
                        "; drive a full turn on the spot each way, or arcs");
  if (open(column::mounting_x) || open(column::mounting_y))
    sentences.push_back(std::string("truth_mounting.") +
                        (open(column::mounting_x) && open(column::mounting_y) ? "x_m and y_m"
                         : open(column::mounting_x)                           ? "x_m"
                                                                              : "y_m") +
                        ": the tracked point's place on the vehicle shows in turns only, and its side only beside "
                        "straights or arcs both ways" +
                        so_far + "; drive turns on the spot and arcs with the truth sampled on the way");
  if (open(column::mounting_heading))
    sentences.push_back("truth_mounting.heading_rad: no straight long enough to see the direction of travel" + so_far +
                        "; drive a straight of a few metres");
  else if (!any_heading)
    sentences.push_back("truth_mounting.heading_rad: the truth has no heading, so there is none to align");
  if (some_clock_is_open)
    sentences.push_back(
        "truth_mounting.time_offset_s: nothing happened at a time that the truth would show; drive with "
        "starts, stops and turns and sample the truth on the way");
  return sentences;
}

}  // namespace

Result<LeastSquaresCalibration> calibrate_least_squares(const std::vector<Recording>& recordings,
                                                        const Vehicle& nominal, const LeastSquaresOptions& options,
                                                        const Progress& progress) {
  if (const auto other = other_than_differential_drive(nominal, "can be calibrated against a truth")) return *other;
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  if (const std::vector<std::string> problems = problems_in(*drive); !problems.empty())
    return Error{nominal.name, "", problems.front()};
  if (recordings.empty()) return Error{"recordings", "none", "one or more"};
  std::vector<InnovationRun> runs;
  bool any_heading = false;
  for (const Recording& recording : recordings) {
    Result<InnovationRun> run = innovation_run(recording, nominal);
    if (!run) return run.error();
    any_heading = any_heading || run->truth_has_heading;
    runs.push_back(std::move(*run));
  }
  const Error stopped{"calibration", "stopped before its end", ""};
  if (const std::string contradiction = contradiction_in(runs, *drive); !contradiction.empty())
    return Error{recordings.size() == 1 ? recordings[0].name : "the recordings", contradiction,
                 "wheels and truth of one robot, in the units that the columns are named after"};
  const FirstGuess guess = first_guess(runs, *drive);
  const std::vector<std::string> jumps = counter_jumps_in(runs);

  std::vector<int> active = {column::wheel_radius_left, column::wheel_radius_right, column::wheelbase};
  if (options.fit_truth_mounting) {
    active.push_back(column::mounting_x);
    active.push_back(column::mounting_y);
    if (any_heading) active.push_back(column::mounting_heading);
  }
  const bool clock_hides_in_place = !any_heading && at_steady_speed(runs, *drive);
  if (clock_hides_in_place) active.erase(std::remove(active.begin(), active.end(), column::mounting_x), active.end());
  const Parameters start{{*drive, nominal.truth, {0.005, 0.005, 0.02}},
                         std::vector<double>(options.one_truth_clock ? 1 : runs.size(), nominal.truth.time_offset_s)};
  if (options.fit_truth_clock && !clock_hides_in_place)
    for (int c = kShared; c < start.size(); ++c) active.push_back(c);
  Fit fit(std::move(runs), start);
  if (guess.trusted && far_apart(guess.drive, *drive)) fit.start_from(guess.drive);

  // Parameters, noise and outliers in turns, each linearised where the last ended: three rounds suffice where nothing
  // is odd, since each depends little on the others.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const FittedNoise before = fit.now().shared.noise;
    fit.fit_parameters(active, 1.0, options.most_iterations);
    if (!goes_on(progress, (round + 0.5) / (kRounds + 1))) return stopped;
    fit.fit_noise(active, round == 0 ? 1.0 : 0.15);
    if (!goes_on(progress, (round + 1.0) / (kRounds + 1))) return stopped;
    const bool changed = fit.gate();
    const FittedNoise& now = fit.now().shared.noise;
    const double moved = std::max({std::abs(std::log(now.wheel_m_per_sqrt_m / before.wheel_m_per_sqrt_m)),
                                   std::abs(std::log(now.truth_position_m / before.truth_position_m)),
                                   std::abs(std::log(now.truth_heading_rad / before.truth_heading_rad))});
    if (round > 0 && !changed && moved < 0.02) break;
  }

  // What these recordings determine, Eq. 11; the rest goes back to its nominal value and the fit is repeated without
  // priors.
  const int n = static_cast<int>(active.size());
  const auto information_of = [&](const Fit::Sums& s) {
    MatrixXd a(n, n);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) a(r, c) = s.information(active[r], active[c]);
    return a;
  };
  fit.fit_parameters(active, 1.0, options.most_iterations);
  const MatrixXd information = information_of(fit.sums(fit.now(), true));
  const MatrixXd posterior = (information + MatrixXd::Identity(n, n)).inverse();
  std::vector<char> determined(start.size(), 0);
  std::vector<int> kept;
  for (int k = 0; k < n; ++k) {
    determined[active[k]] = std::sqrt(posterior(k, k)) < kDetermined;
    if (determined[active[k]])
      kept.push_back(active[k]);
    else
      fit.hold_at_nominal(active[k]);
  }
  fit.fit_parameters(kept, 0.0, options.most_iterations);
  if (!goes_on(progress, 1.0)) return stopped;

  LeastSquaresCalibration result;
  result.warnings = jumps;
  const InnovationModel& model = fit.now().shared;
  fit.correlations(result.correlation);
  constexpr int kBatches = 60;
  const Fit::Sums final_sums = fit.sums(fit.now(), true, kBatches);
  result.innovations = final_sums.scalars;

  // Standard errors: what is held at its nominal value stays uncertain by its prior.
  MatrixXd precision = information_of(final_sums);
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
    result.warnings.push_back(
        text("the innovations are correlated (%.2f from one to the next): there is something that these "
             "parameters do not describe; standard errors were enlarged, at most by a factor of %.1f",
             largest, most));
  }

  // As reported: the shared parameters, and the mean of the clocks weighted by their precision.
  MatrixXd reported = MatrixXd::Zero(kColumns, n);
  double weights = 0.0;
  for (int k = 0; k < n; ++k) {
    if (active[k] < kShared) reported(active[k], k) = 1.0;
    if (active[k] >= kShared && determined[active[k]])
      weights += reported(column::truth_clock, k) = 1.0 / covariance(k, k);
  }
  if (weights > 0.0) reported.row(column::truth_clock) /= weights;
  const MatrixXd reported_covariance = reported * covariance * reported.transpose();
  double clock_s = nominal.truth.time_offset_s, clock_scatter = 0.0;
  for (int k = 0; k < n; ++k)
    if (active[k] >= kShared)
      clock_s += reported(column::truth_clock, k) * (Fit::value(fit.now(), active[k]) - nominal.truth.time_offset_s);
  std::vector<int> shown;
  for (int c = 0; c < kColumns; ++c) {
    if (c == column::truth_clock ? !options.fit_truth_clock : c > column::wheelbase && !options.fit_truth_mounting)
      continue;
    const auto at = std::find(active.begin(), active.end(), c);
    ParameterEstimate p;
    p.name = kNames[c].key;
    p.unit = kNames[c].unit;
    p.nominal = c == column::truth_clock ? nominal.truth.time_offset_s : Fit::value(start, c);
    p.value = c == column::truth_clock ? clock_s : Fit::value(fit.now(), c);
    p.determined = c == column::truth_clock ? weights > 0.0 : determined[c] != 0;
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
  result.cannot_tell =
      what_cannot_be_told(determined, active, information, driven_in(fit.runs(), model.drive), any_heading);
  if (clock_hides_in_place)
    result.cannot_tell.push_back(
        "truth_mounting.x_m and time_offset_s: at a steady speed, and without headings, a late clock looks like a "
        "tracked point "
        "further behind; both stay as given. Change the speed on the way, or stop now and then");
  result.normalised_chi2 = final_sums.chi2 / std::max(1, final_sums.scalars);
  Parameters as_nominal = start;
  as_nominal.shared.noise = model.noise;
  const Fit::Sums nominal_sums = fit.sums(as_nominal, false);
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
    result.warnings.push_back("the truth contradicts the wheels for 20 samples or more at " +
                              std::to_string(fit.restarts()) + " places; the fit starts anew behind them");
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

}  // namespace odolab
