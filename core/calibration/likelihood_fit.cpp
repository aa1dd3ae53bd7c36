#include "core/calibration/likelihood_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/base/parallel.h"
#include "core/calibration/left_out.h"
#include "core/calibration/noise_fit.h"

namespace odolab {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kColumns = column::first_extra;
constexpr int kNoiseSamples = 6000;  // truth samples that the noise is fitted to
constexpr int kNoiseStretch = 500;   // in stretches of this many

}  // namespace

std::vector<double> prior_sizes(const FitParameters& nominal) {
  const DifferentialDrive& drive = nominal.shared.drive;
  std::vector<double> sizes = {
      0.1 * drive.wheel_radius_left_m, 0.1 * drive.wheel_radius_right_m, 0.1 * drive.wheelbase_m, 0.2, 0.2, 0.3};
  sizes.resize(nominal.size(), 0.2);
  return sizes;
}

double& parameter_of(FitParameters& parameters, int c) {
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
      return parameters.clock_s[c - column::shared];
  }
}

LikelihoodFit::Sums LikelihoodFit::sums(const FitParameters& parameters, bool derivatives, int batches) const {
  FilterOptions options;
  options.derivatives = derivatives;
  if (batches > 0) options.batch = std::max(1, truth_samples() / batches);
  const int n = static_cast<int>(runs_.size());
  std::vector<InnovationSums> of_run(n);
  each(n, [&](int r) {
    const InnovationModel model = parameters.of(r);
    of_run[r] = filtered(runs_[r], summed(r, model), model, options);
  });
  Sums total = none();
  for (int r = 0; r < n; ++r) add(total, r, of_run[r]);
  return total;
}

const SummedRun& LikelihoodFit::summed(int run, const InnovationModel& model) const {
  Kept& kept = kept_[static_cast<std::size_t>(run)];
  const DifferentialDrive &was = kept.drive, &is = model.drive;
  const bool body_is_noisy = model.noise.along_m_per_sqrt_m > 0.0;
  if (kept.summed.motions.empty() || was.wheel_radius_left_m != is.wheel_radius_left_m ||
      was.wheel_radius_right_m != is.wheel_radius_right_m || was.wheelbase_m != is.wheelbase_m ||
      kept.clock_s != model.truth.time_offset_s || kept.body_is_noisy != body_is_noisy)
    kept = {is, model.truth.time_offset_s, body_is_noisy, summed_up(runs_[static_cast<std::size_t>(run)], model)};
  return kept.summed;
}

void LikelihoodFit::each(int count, const std::function<void(int)>& work) const {
  constexpr int kWorthThreads = 5000;
  if (truth_samples() > kWorthThreads)
    parallel_for(count, work);
  else
    for (int i = 0; i < count; ++i) work(i);
}

MatrixXd LikelihoodFit::information_held(const std::vector<int>& active) const {
  constexpr double kHeld = 1e8;  // to a ten-thousandth of its prior
  const auto n = static_cast<Eigen::Index>(active.size());
  VectorXd mean = VectorXd::Zero(n), clocks = VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int c = active[static_cast<std::size_t>(k)];
    if (c == column::wheel_radius_left || c == column::wheel_radius_right) mean(k) = 0.5;
    if (c >= column::shared) clocks(k) = 1.0;
  }
  MatrixXd held = mean_radius_is_held_ ? MatrixXd(kHeld * mean * mean.transpose()) : MatrixXd::Zero(n, n);
  if (clocks_keep_priors_) held.diagonal() += clocks;
  return held;
}

MatrixXd LikelihoodFit::as_it_falls(const std::vector<int>& active, const MatrixXd& information) const {
  constexpr int kRounds = 6;
  constexpr double kLeast = 0.1, kAsMuch = 0.9;  // of it, at once
  const MatrixXd of_data = sums(now_, true).information(active, active), beside = information - of_data;
  const auto likelihood = [&](const VectorXd& step) {
    FitParameters at = now_;
    for (Eigen::Index k = 0; k < step.size(); ++k)
      parameter_of(at, active[static_cast<std::size_t>(k)]) += step(k) * prior_[active[static_cast<std::size_t>(k)]];
    if (!problems_in(at.shared.drive).empty()) return std::numeric_limits<double>::infinity();
    const Sums s = sums(at, false);
    return s.chi2 + s.log_determinant + step.dot(beside * step);
  };
  const double here = likelihood(VectorXd::Zero(information.rows()));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(information);
  VectorXd along = axes.eigenvalues();
  for (Eigen::Index k = 0; k < along.size(); ++k)
    for (int round = 0; round < kRounds; ++round) {
      const VectorXd step = axes.eigenvectors().col(k) / std::sqrt(along(k));
      const double falls = 0.5 * (likelihood(step) + likelihood(-step)) - here;  // 1 of a parabola
      if (!std::isfinite(falls)) break;
      along(k) *= std::clamp(falls, kLeast, 1.0);
      if (falls > kAsMuch) break;
    }
  return axes.eigenvectors() * along.asDiagonal() * axes.eigenvectors().transpose();
}

void LikelihoodFit::fit_parameters(const std::vector<int>& active, double weight, int most_iterations) {
  const MatrixXd held = information_held(active);
  const bool headings_are_open = leaves_headings_open();
  const auto away = [&](const FitParameters& at) {
    VectorXd of(static_cast<Eigen::Index>(active.size()));
    for (std::size_t k = 0; k < active.size(); ++k) of(static_cast<Eigen::Index>(k)) = deviation(at, active[k]);
    return of;
  };
  const auto objective = [&](const Sums& s, const FitParameters& at) {
    const VectorXd from_nominal = away(at);
    const double of_headings = headings_are_open ? s.log_determinant : 0.0;
    return s.chi2 + of_headings + weight * from_nominal.squaredNorm() + from_nominal.dot(held * from_nominal);
  };
  Sums now = sums_now();
  double value = objective(now, now_);
  double damping = 1e-6;
  constexpr double kNothing = 1e-6;  // a thousandth of a standard deviation
  // A tenth of one: the slope, which is of smoothed wheels, promises no more what the jagged ones keep.
  constexpr double kSmall = 1e-2;
  const int n = static_cast<int>(active.size());
  for (int i = 0; i < most_iterations; ++i) {
    MatrixXd a(n, n);
    VectorXd g(n);
    for (int r = 0; r < n; ++r) {
      for (int c = 0; c < n; ++c) a(r, c) = now.information(active[r], active[c]) + held(r, c);
      a(r, r) += weight;
      g(r) = now.score(active[r]) - weight * deviation(now_, active[r]);
    }
    g -= held * away(now_);
    bool accepted = false;
    double size = 0.0;
    for (int attempt = 0; attempt < 8 && !accepted && !(attempt > 0 && size < kSmall); ++attempt) {
      MatrixXd damped = a;
      for (int r = 0; r < n; ++r) damped(r, r) *= 1.0 + damping;
      const VectorXd step = damped.ldlt().solve(g);
      size = step.dot(a * step);
      if (size < kNothing) break;
      FitParameters candidate = now_;
      for (int r = 0; r < n; ++r) parameter_of(candidate, active[r]) += step(r) * prior_[active[r]];
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
      damping = std::max(30.0 * damping, 0.1);
    }
    if (!accepted) break;
  }
  sums_now_ = std::move(now);
}

const LikelihoodFit::Sums& LikelihoodFit::sums_now() {
  if (!sums_now_) sums_now_ = sums(now_, true);
  return *sums_now_;
}

void LikelihoodFit::fit_noise(const std::vector<int>& active) {
  const bool any_heading = std::any_of(runs_.begin(), runs_.end(), std::mem_fn(&InnovationRun::truth_has_heading));
  const bool restricted = truth_samples() < 1000, of_body = any_heading && !restricted;
  if (of_body) now_.shared.noise = with_body(now_.shared.noise);
  std::vector<const SummedRun*> of_run;
  for (int r = 0; r < static_cast<int>(runs_.size()); ++r) of_run.push_back(&summed(r, now_.of(r)));
  std::vector<const InnovationRun*> all;
  for (const InnovationRun& run : runs_) all.push_back(&run);
  // All truth, or stretches spread evenly where there is more than the noise needs.
  const int every = std::max(1, (truth_samples() + kNoiseSamples - 1) / kNoiseSamples);
  const std::vector<NoiseStretch> stretches = noise_stretches(all, every, kNoiseStretch);
  const auto with = [&](const FittedNoise& noise, int run) {
    InnovationModel model = now_.of(run);
    model.noise = noise;
    return model;
  };
  // Logarithm of the determinant of what is known of the parameters: the freedom that they took.
  const auto freedom_taken = [&](const FittedNoise& noise) {
    std::vector<InnovationSums> of_stretch(stretches.size());
    each(static_cast<int>(stretches.size()), [&](int i) {
      const NoiseStretch& s = stretches[i];
      FilterOptions options;
      options.first = s.first;
      options.last = s.last;
      of_stretch[i] = filtered(runs_[s.run], *of_run[s.run], with(noise, s.run), options);
    });
    Sums total = none();
    for (std::size_t i = 0; i < stretches.size(); ++i) add(total, stretches[i].run, of_stretch[i]);
    MatrixXd a(active.size(), active.size());
    for (std::size_t r = 0; r < active.size(); ++r)
      for (std::size_t c = 0; c < active.size(); ++c) a(r, c) = total.information(active[r], active[c]) + (r == c);
    return a.ldlt().vectorD().array().log().sum();
  };
  NoiseFit fit{{noise_size::wheel, noise_size::position}, kUsualNoise};
  fit.expect_usual_truth_of(truth_samples());
  if (any_heading) fit.free.push_back(noise_size::heading);
  if (of_body) fit.add_body();
  const auto likelihood = [&](const FittedNoise& noise) {
    std::vector<NoiseSlopes> of_stretch(stretches.size());
    each(static_cast<int>(stretches.size()), [&](int i) {
      const NoiseStretch& s = stretches[i];
      of_stretch[i] = noise_slopes(runs_[s.run], *of_run[s.run], with(noise, s.run), s.first, s.last);
    });
    NoiseSlopes sum;
    for (const NoiseSlopes& s : of_stretch) sum.add(s);
    if (!restricted) return sum;
    const double taken = freedom_taken(noise);
    sum.value += taken;
    constexpr double kBy = 1e-4;  // of logarithms
    for (int size : fit.free) {
      FittedNoise larger = noise;
      size_of(larger, size) *= std::exp(kBy);
      sum.slope[size] += (freedom_taken(larger) - taken) / kBy;
    }
    return sum;
  };
  now_.shared.noise = most_likely_noise(likelihood, now_.shared.noise, fit);
  sums_now_.reset();
}

bool LikelihoodFit::gate() {
  FilterOptions options;
  options.derivatives = false;
  options.gate = kGate;
  const int n = static_cast<int>(runs_.size());
  std::vector<char> changed(runs_.size(), 0);
  std::vector<int> restarts(runs_.size(), 0);
  each(n, [&](int r) {
    const InnovationModel model = now_.of(r);
    const std::vector<char> cut = runs_[r].cut;
    cut_where_left_out(runs_[r], model.truth.time_offset_s);
    InnovationSums s = filtered(runs_[r], summed(r, model), model, options);
    changed[r] = runs_[r].cut != cut || s.set_aside != runs_[r].set_aside;
    restarts[r] = s.restarts;
    runs_[r].set_aside = std::move(s.set_aside);
  });
  restarts_ = std::accumulate(restarts.begin(), restarts.end(), 0);
  sums_now_.reset();
  return std::find(changed.begin(), changed.end(), 1) != changed.end();
}

void LikelihoodFit::correlations(double* out) const {
  struct Products {
    double product[3] = {}, square[3] = {};
  };
  std::vector<Products> of_run(runs_.size());
  each(static_cast<int>(runs_.size()), [&](int r) {
    Products& sum = of_run[static_cast<std::size_t>(r)];
    bool has_before = false;
    double before[3] = {};
    FilterOptions options;
    options.derivatives = false;
    options.on_innovation = [&](const Innovation& i) {
      for (int k = 0; k < i.size; ++k) {
        if (has_before) sum.product[k] += before[k] * i.white[k];
        sum.square[k] += i.white[k] * i.white[k];
        before[k] = i.white[k];
      }
      has_before = true;
    };
    const InnovationModel model = now_.of(r);
    filtered(runs_[r], summed(r, model), model, options);
  });
  for (int k = 0; k < 3; ++k) {
    double product = 0.0, square = 0.0;
    for (const Products& sum : of_run) product += sum.product[k], square += sum.square[k];
    out[k] = square > 0.0 ? product / square : 0.0;
  }
}

LikelihoodFit::Lasting LikelihoodFit::lasting_correlation() const {
  constexpr double kReadings = 2.0;  // beside the same reading they share its rounding
  struct Products {
    std::array<double, 3> product{}, square{};
    double count = 0.0;
    // Of what is more than chance makes of so many: white noise correlates to within 1 / sqrt(count).
    double largest() const {
      constexpr double kSigmas = 2.5;
      double most = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        if (product[k] * std::sqrt(count) > kSigmas * square[k]) most = std::max(most, product[k] / square[k]);
      return most;
    }
  };
  std::vector<Products> a_reading(runs_.size()), a_second(runs_.size());
  each(static_cast<int>(runs_.size()), [&](int r) {
    std::vector<std::array<double, 3>> white;
    FilterOptions options;
    options.derivatives = false;
    options.on_innovation = [&](const Innovation& i) {
      white.push_back({});
      for (int k = 0; k < i.size; ++k) white.back()[static_cast<std::size_t>(k)] = i.white[k];
    };
    const InnovationModel model = now_.of(r);
    filtered(runs_[r], summed(r, model), model, options);
    const auto period_s = [](const auto& samples) {
      return (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
    };
    const auto add = [&](Products& sum, double apart_s) {
      const auto lag =
          static_cast<std::size_t>(std::clamp(std::round(apart_s / period_s(runs_[r].truth)), 1.0, 1000.0));
      for (std::size_t i = lag; i < white.size(); ++i, sum.count += 1.0)
        for (std::size_t k = 0; k < 3; ++k) {
          sum.product[k] += white[i][k] * white[i - lag][k];
          sum.square[k] += white[i][k] * white[i][k];
        }
    };
    add(a_reading[static_cast<std::size_t>(r)], kReadings * period_s(runs_[r].wheels));
    add(a_second[static_cast<std::size_t>(r)], 1.0);
  });
  const auto largest = [](const std::vector<Products>& of_run) {
    Products sum;
    for (const Products& p : of_run) {
      sum.count += p.count;
      for (std::size_t k = 0; k < 3; ++k) sum.product[k] += p.product[k], sum.square[k] += p.square[k];
    }
    return sum.largest();
  };
  return {largest(a_reading), largest(a_second)};
}

LikelihoodFit::Sums LikelihoodFit::none() const {
  const int n = now_.size();
  Sums zero;
  zero.information = zero.scatter = MatrixXd::Zero(n, n);
  zero.score = VectorXd::Zero(n);
  return zero;
}

void LikelihoodFit::add(Sums& total, int recording, const InnovationSums& s) const {
  total.chi2 += s.chi2;
  total.log_determinant += s.log_determinant;
  total.scalars += s.scalars;
  if (s.score.empty()) return;
  std::array<int, kColumns> at;
  for (int c = 0; c < kColumns; ++c) at[c] = c < column::shared ? c : now_.clock_of(recording);
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

}  // namespace odolab
