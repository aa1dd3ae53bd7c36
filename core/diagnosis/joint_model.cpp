#include "core/diagnosis/joint_model.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/calibration/minimise.h"
#include "core/calibration/thinned_truth.h"
#include "core/diagnosis/counts_at_rest.h"
#include "core/diagnosis/ready_run.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBatches = 60;
constexpr int kNoiseSamples = 5000;
constexpr double kFewestToValidate = 4.0;
constexpr double kPriorBatches = 6.0;  // the weight of believing that the innovations are white

// An inflation of one or more from the scatter of so many batches, relative to what it should be.
double shrunk_inflation(double scatter, double count) {
  const double own = count > 1.5 ? scatter * count / (count - 1.0) : 1.0;
  return std::max(1.0, (kPriorBatches + count * own) / (kPriorBatches + count));
}

double& entry(InnovationModel& m, int c) {
  switch (c) {
    case 0:
      return m.drive.wheel_radius_left_m;
    case 1:
      return m.drive.wheel_radius_right_m;
    case 2:
      return m.drive.wheelbase_m;
    case 3:
      return m.truth.axle_T_tracked.x_m;
    case 4:
      return m.truth.axle_T_tracked.y_m;
    default:
      return m.truth.axle_T_tracked.heading_rad;
  }
}

}  // namespace

double chi_square_tail(double x, int freedom) {
  if (x <= 0.0) return 1.0;
  // Regularised incomplete gamma by recurrence from freedom 1 or 2.
  double tail = freedom % 2 == 0 ? std::exp(-0.5 * x) : std::erfc(std::sqrt(0.5 * x));
  double term = freedom % 2 == 0 ? std::exp(-0.5 * x) : std::sqrt(2.0 * x / kPi) * std::exp(-0.5 * x);
  for (int k = freedom % 2 == 0 ? 2 : 1; k < freedom; k += 2) {
    if (freedom % 2 == 0) term *= 0.5 * x / (0.5 * k);
    tail += term;
    if (freedom % 2 == 1) term *= x / (k + 2);
  }
  return std::min(1.0, tail);
}

double scaled_chi_square_tail(double x, int freedom, double batches) {
  if (x <= 0.0) return 1.0;
  if (batches > 1e4) return chi_square_tail(x, freedom);
  // I_z(a, b) by its power series, all of whose terms are positive.
  const double a = 0.5 * batches, b = 0.5 * freedom, z = batches / (batches + x);
  double term = 1.0, sum = 1.0;
  for (int n = 1; n < 10000 && term > 1e-15 * sum; ++n) {
    term *= z * (a + b + n - 1.0) / (a + n);
    sum += term;
  }
  const double log_front =
      a * std::log(z) + b * std::log1p(-z) - std::log(a) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  return std::min(1.0, std::exp(log_front) * sum);
}

JointModel::JointModel(std::vector<InnovationRun> runs, std::vector<char> from_commands,
                       const LeastSquaresCalibration& start, const Vehicle& nominal)
    : runs_(std::move(runs)), from_commands_(std::move(from_commands)), nominal_(nominal) {
  model.drive = std::get<DifferentialDrive>(start.vehicle.kind);
  model.truth = start.vehicle.truth;
  model.noise = start.noise;
  if (model.noise.truth_heading_rad <= 0.0) model.noise.truth_heading_rad = 0.01;
  if (model.noise.body_m_per_sqrt_m <= 0.0)
    model.noise.body_m_per_sqrt_m = model.noise.sideways_m_per_sqrt_m = 0.3 * model.noise.wheel_m_per_sqrt_m;
  clock_s = start.time_offset_s;
  clock_s.resize(runs_.size(), model.truth.time_offset_s);
  clock_active.assign(runs_.size(), 1);
  for (const InnovationRun& run : runs_) masked_.push_back(run.set_aside);
  for (std::size_t r = 0; r < runs_.size(); ++r) numbers_.push_back(static_cast<int>(r));
}

InnovationModel JointModel::model_of(int run) const {
  InnovationModel m = model;
  m.truth.time_offset_s = clock_s[run];
  return m;
}

InnovationRun JointModel::prepared(int r) const {
  InnovationRun run = runs_[r];
  ExtraColumn sum;
  sum.name = "effects";
  sum.value = 1.0;
  sum.per_step.resize(run.wheels.size() - 1);
  bool any = false;
  for (const ExtraColumn& given : run.extra) {
    any = true;
    for (std::size_t i = 0; i < sum.per_step.size(); ++i) {
      sum.per_step[i].forward_m += given.value * given.per_step[i].forward_m;
      sum.per_step[i].sideways_m += given.value * given.per_step[i].sideways_m;
      sum.per_step[i].turn_rad += given.value * given.per_step[i].turn_rad;
    }
  }
  if (run.counts_show && (half_counts[0] != 0.0 || half_counts[1] != 0.0)) {
    const std::array<Motions, 2> of_wheel = counts_at_rest(runs_[r], model.drive);
    for (int k = 0; k < 2; ++k) of_wheel[k].add_to(sum.per_step, half_counts[k]);
    any = true;
  }
  for (const AcceptedEffect& a : accepted) {
    if (a.effect->clock_rate) {
      put_clock_right(run, a.value[0], clock_s[r]);
      continue;
    }
    const std::vector<Motions> motions = a.effect->motions(read_views_[r], a.shape);
    any = true;
    for (std::size_t k = 0; k < motions.size(); ++k) motions[k].add_to(sum.per_step, a.value[k]);
  }
  if (any) run.extra = {std::move(sum)};
  return run;
}

int JointModel::columns() const {
  int n = first_amplitude();
  for (const AcceptedEffect& a : accepted) n += static_cast<int>(a.value.size());
  return n;
}

void JointModel::linearise() {
  const int n = static_cast<int>(runs_.size());
  std::vector<Track> track(n);
  if (linear_.size() == runs_.size())
    for (int r = 0; r < n; ++r) track[r] = poses(r);
  views_.resize(n);
  read_views_.resize(n);
  std::vector<std::vector<LinearisedRun>> made(n);
  z_.assign(n, {});
  residual_.assign(n, {});
  const int q = columns();
  parallel_for(n, [&](int r) {
    const InnovationModel m = model_of(r);
    if (track[r].empty()) {  // the places come from the filter itself
      LinearisedRun first(runs_[r], m);
      for (const FilterStep& s : first.steps())
        if (s.truth_index >= 0) track[r].push_back({runs_[r].truth[s.truth_index].time_s - clock_s[r], s.pose});
    }
    views_[r] = drive_view(numbers_[r], runs_[r], m.drive, from_commands_[r] != 0, track[r], Way::smoothed);
    if (!accepted.empty())
      read_views_[r] = drive_view(numbers_[r], runs_[r], m.drive, from_commands_[r] != 0, track[r], Way::as_read);
    made[r].emplace_back(prepared(r), m);
    const LinearisedRun& linear = made[r][0];
    const int rows = 3 * linear.samples();
    MatrixXd& z = z_[r];
    z = MatrixXd::Zero(rows, q);
    for (int c = 0; c < 6; ++c)
      if (nuisance_active[c]) linear.of_parameter(c, z.col(c).data());
    if (clock_active[r]) linear.of_parameter(column::truth_clock, z.col(clock_column(r)).data());
    if (runs_[r].counts_show) {
      const std::array<Motions, 2> of_wheel = counts_at_rest(runs_[r], model.drive);
      for (int k = 0; k < 2; ++k) linear.of_motion(of_wheel[k], z.col(half_count_column(k)).data());
    }
    int k = first_amplitude();
    for (const AcceptedEffect& a : accepted) {
      if (a.effect->clock_rate) {
        linear.of_clock_rate(z.col(k++).data());
        continue;
      }
      for (const Motions& m_k : a.effect->motions(views_[r], a.shape)) linear.of_motion(m_k, z.col(k++).data());
    }
    residual_[r] = Eigen::Map<const VectorXd>(linear.residual().data(), rows);
  });
  linear_.clear();
  for (auto& one : made) linear_.push_back(std::move(one[0]));
  gram_ = MatrixXd::Zero(q, q);
  zr_ = VectorXd::Zero(q);
  chi2_ = log_determinant_ = 0.0;
  scalars_ = 0;
  for (int r = 0; r < n; ++r) {
    gram_.noalias() += z_[r].transpose() * z_[r];
    zr_.noalias() += z_[r].transpose() * residual_[r];
    chi2_ += linear_[r].sums().chi2;
    log_determinant_ += linear_[r].sums().log_determinant;
    scalars_ += linear_[r].sums().scalars;
  }
  // Priors as in calibration: wide, so that what these runs do not determine stays where it was.
  const DifferentialDrive& d = std::get<DifferentialDrive>(nominal_.kind);
  const double size[6] = {
      0.1 * d.wheel_radius_left_m, 0.1 * d.wheel_radius_right_m, 0.1 * d.wheelbase_m, 0.2, 0.2, 0.3};
  InnovationModel nominal{d, nominal_.truth, {}}, now = model;
  for (int c = 0; c < 6; ++c) {
    gram_(c, c) += 1.0 / (size[c] * size[c]);
    zr_(c) += nuisance_active[c] ? (entry(nominal, c) - entry(now, c)) / (size[c] * size[c]) : 0.0;
  }
  for (int r = 0; r < n; ++r) {
    gram_(6 + r, 6 + r) += 25.0;
    zr_(6 + r) += clock_active[r] ? 25.0 * (nominal_.truth.time_offset_s - clock_s[r]) : 0.0;
  }
  for (int k = 0; k < 2; ++k) {  // a share between none and all
    gram_(half_count_column(k), half_count_column(k)) += 1.0;
    zr_(half_count_column(k)) -= half_counts[k];
  }
  for (int k = first_amplitude(); k < q; ++k) gram_(k, k) += 1e-12;
}

void JointModel::fit(int iterations) {
  linearise();
  for (int i = 0; i < iterations; ++i) {
    const VectorXd step = gram_.ldlt().solve(zr_);
    if (!step.allFinite()) return;
    const double size = step.dot(zr_);
    const auto saved_accepted = accepted;
    const InnovationModel saved = model;
    const std::vector<double> saved_clock = clock_s;
    const std::array<double, 2> saved_half_counts = half_counts;
    const double before = chi2_;
    double scale = 1.0;
    for (int attempt = 0; attempt < 3; ++attempt, scale *= 0.3) {
      model = saved;
      clock_s = saved_clock;
      accepted = saved_accepted;
      for (int c = 0; c < 6; ++c) entry(model, c) += scale * step(c);
      for (std::size_t r = 0; r < runs_.size(); ++r) clock_s[r] += scale * step(6 + r);
      for (int w = 0; w < 2; ++w) half_counts[w] = saved_half_counts[w] + scale * step(half_count_column(w));
      int k = first_amplitude();
      for (AcceptedEffect& a : accepted) {
        for (std::size_t j = 0; j < a.value.size(); ++j, ++k)
          a.value[j] =
              std::clamp(a.value[j] + scale * step(k), a.effect->amplitudes[j].low, a.effect->amplitudes[j].high);
        if (a.effect->shape_follows_amplitude) a.shape[0] = std::max(0.5 * (a.shape[0] + a.value[0]), 1e-4);
      }
      linearise();
      if (std::isfinite(chi2_) && chi2_ < before * 1.02 + 20.0) break;
    }
    if (size < 0.01) break;
  }
  const MatrixXd cov = covariance();
  int k = first_amplitude();
  for (AcceptedEffect& a : accepted) {
    a.stderr_value.resize(a.value.size());
    for (std::size_t j = 0; j < a.value.size(); ++j, ++k) a.stderr_value[j] = std::sqrt(std::max(0.0, cov(k, k)));
  }
}

void JointModel::fit_noise() {
  constexpr double kUsual[5] = {0.003, 0.002, 0.0005, 0.0005, 0.005};
  // A model is not trusted to be truer sideways than this share of the wheels' noise.
  constexpr double kLeastSideways = 0.05;
  constexpr double kWay_m = 0.1;
  bool any_heading = false;
  for (const InnovationRun& run : runs_) any_heading = any_heading || run.truth_has_heading;
  std::vector<double> logs = {std::log(model.noise.wheel_m_per_sqrt_m), std::log(model.noise.truth_position_m),
                              std::log(model.noise.body_m_per_sqrt_m), std::log(model.noise.sideways_m_per_sqrt_m)};
  if (any_heading) logs.push_back(std::log(model.noise.truth_heading_rad));
  const auto noise_of = [&](const std::vector<double>& at) {
    return FittedNoise{std::exp(at[0]), std::exp(at[1]), any_heading ? std::exp(at[4]) : model.noise.truth_heading_rad,
                       std::exp(at[2]), std::max(std::exp(at[3]), kLeastSideways * std::exp(at[0]))};
  };
  // Twice the negative log-likelihood of the noise on these runs, of which every so many stretches are used; `scales`:
  // those of the logarithms that are free.
  const auto fitted = [&](const std::vector<const InnovationRun*>& runs, const std::vector<int>& scales) {
    std::vector<SummedRun> summed;
    int samples = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      summed.push_back(summed_up(*runs[r], model_of(static_cast<int>(r))));
      samples += static_cast<int>(runs[r]->truth.size());
    }
    const int every = std::max(1, samples / kNoiseSamples), stretch = 250;
    const double parameters = columns();
    const auto value = [&](const std::vector<double>& free) {
      std::vector<double> at = logs;
      for (std::size_t k = 0; k < scales.size(); ++k) at[static_cast<std::size_t>(scales[k])] = free[k];
      std::vector<double> sum_of(runs.size(), 0.0);
      std::vector<int> scalars_of(runs.size(), 0);
      const auto of_run = [&](int r) {
        InnovationModel m = model_of(r);
        m.noise = noise_of(at);
        FilterOptions options;
        options.derivatives = false;
        const int n = static_cast<int>(runs[r]->truth.size());
        for (int first = 0, number = r; first + 1 < n; first += every == 1 ? n : stretch, ++number) {
          if (number % every != 0) continue;
          options.first = first;
          options.last = every == 1 ? n : std::min(n, first + stretch);
          const InnovationSums s = filtered(*runs[r], summed[r], m, options);
          sum_of[r] += s.chi2 + s.log_determinant;
          scalars_of[r] += s.scalars;
        }
      };
      if (samples > kNoiseSamples)
        parallel_for(static_cast<int>(runs.size()), of_run);
      else  // not worth starting threads for
        for (std::size_t r = 0; r < runs.size(); ++r) of_run(static_cast<int>(r));
      double sum = 0.0;
      int scalars = 0;
      for (std::size_t r = 0; r < runs.size(); ++r) sum += sum_of[r], scalars += scalars_of[r];
      // The freedom that the parameters took, as an average: exact where all scales move together.
      if (every == 1 && scalars > 2 * parameters) sum -= parameters * (free[0] + free[1]);
      for (std::size_t k = 0; k < scales.size(); ++k) sum += std::pow((free[k] - std::log(kUsual[scales[k]])) / 2.3, 2);
      return sum;
    };
    std::vector<double> start;
    for (int k : scales) start.push_back(logs[static_cast<std::size_t>(k)]);
    const std::vector<double> best = minimised(value, start, 0.2, 0.05, 110);
    for (std::size_t k = 0; k < scales.size(); ++k) logs[static_cast<std::size_t>(scales[k])] = best[k];
  };
  std::vector<const InnovationRun*> whole;
  for (const LinearisedRun& l : linear_) whole.push_back(&l.run());
  fitted(whole, any_heading ? std::vector<int>{0, 1, 2, 3, 4} : std::vector<int>{0, 1, 2, 3});
  // The truth's noise shows from sample to sample; the floor's in what it adds up to.
  std::vector<InnovationRun> thin;
  for (std::size_t r = 0; r < whole.size(); ++r)
    thin.push_back(thinned_truth(*whole[r], model_of(static_cast<int>(r)), kWay_m));
  std::vector<const InnovationRun*> thinned;
  int left = 0;
  for (const InnovationRun& run : thin)
    if (run.truth.size() >= 2) thinned.push_back(&run), left += static_cast<int>(run.truth.size());
  if (thinned.size() == whole.size() && left > 3 * columns()) fitted(thinned, {0, 2, 3});
  model.noise = noise_of(logs);
}

void JointModel::gate() {
  FilterOptions options;
  options.derivatives = false;
  options.gate = 30.0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const InnovationModel m = model_of(static_cast<int>(r));
    const InnovationRun run = prepared(static_cast<int>(r));
    std::vector<char> aside = filtered(run, summed_up(run, m), m, options).set_aside;
    // More than a few in a row are no outliers: something happened there that is to be explained.
    for (std::size_t i = 0; i < aside.size();) {
      std::size_t j = i;
      while (j < aside.size() && aside[j]) ++j;
      if (j - i > 4) std::fill(aside.begin() + i, aside.begin() + j, 0);
      i = std::max(j, i + 1);
    }
    for (std::size_t i = 0; i < aside.size(); ++i) aside[i] = std::max(aside[i] ? char{1} : char{0}, masked_[r][i]);
    runs_[r].set_aside = std::move(aside);
  }
}

MatrixXd JointModel::covariance() const { return gram_.ldlt().solve(MatrixXd::Identity(gram_.rows(), gram_.cols())); }

double JointModel::stderr_of_nuisance(int c) const { return std::sqrt(std::max(0.0, covariance()(c, c))); }

int JointModel::first_column(int which) const {
  int n = first_amplitude();
  for (int a = 0; a < which; ++a) n += static_cast<int>(accepted[static_cast<std::size_t>(a)].value.size());
  return n;
}

VectorXd JointModel::inflation_of_columns() const {
  const MatrixXd cov = covariance();
  const VectorXd left = cov * zr_;  // what the last step of the fit did not take
  int samples = 0;
  for (const LinearisedRun& l : linear_) samples += l.samples();
  const int batch = std::max(1, samples / kBatches), q = columns();
  VectorXd scatter = VectorXd::Zero(q), info = VectorXd::Zero(q), square = VectorXd::Zero(q);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const VectorXd res = residual_[r] - z_[r] * left;
    const MatrixXd influence = z_[r] * cov;
    const int n = linear_[r].samples();
    for (int from = 0; from < n; from += batch) {
      const int rows = 3 * (std::min(n, from + batch) - from);
      const VectorXd u = influence.middleRows(3 * from, rows).transpose() * res.segment(3 * from, rows);
      const VectorXd i = influence.middleRows(3 * from, rows).colwise().squaredNorm().transpose();
      scatter += u.cwiseAbs2();
      info += i;
      square += i.cwiseAbs2();
    }
  }
  VectorXd inflation = VectorXd::Ones(q);
  for (int c = 0; c < q; ++c)
    if (info(c) > 0.0 && square(c) > 0.0)
      inflation(c) = shrunk_inflation(scatter(c) / info(c), info(c) * info(c) / square(c));
  return inflation;
}

MatrixXd JointModel::absorbed(const CandidateColumns& c) const {
  Eigen::Index k = 0;
  for (const MatrixXd& m : c.of_run) k = std::max(k, m.cols());
  MatrixXd cross = MatrixXd::Zero(gram_.rows(), k);
  for (std::size_t r = 0; r < runs_.size(); ++r)
    if (c.of_run[r].size() > 0)
      cross.noalias() += z_[r].middleRows(3 * c.stretch[r].first, c.of_run[r].rows()).transpose() * c.of_run[r];
  return gram_.ldlt().solve(cross);
}

JointModel JointModel::left_out(int run) const {
  const MatrixXd own = z_[run].transpose() * z_[run];
  MatrixXd gram = gram_ - own;
  VectorXd zr = zr_ - z_[run].transpose() * residual_[run];
  JointModel one;  // of that run: a copy of all runs would cost more than the step
  one.model = model;
  one.half_counts = half_counts;
  one.nuisance_active = nuisance_active;
  one.nominal_ = nominal_;
  // What only this run could tell is not known from the others.
  std::vector<char> unknown(gram.rows(), 0);
  for (Eigen::Index c = 0; c < gram.rows(); ++c)
    if (gram(c, c) < 1e-6 * gram_(c, c)) {
      unknown[c] = 1;
      gram.row(c).setZero();
      gram.col(c).setZero();
      gram(c, c) = 1.0;
      zr(c) = 0.0;
    }
  const VectorXd step = gram.ldlt().solve(zr);
  if (step.allFinite())
    for (int c = 0; c < 6; ++c) entry(one.model, c) += step(c);
  if (step.allFinite())
    for (int w = 0; w < 2; ++w) one.half_counts[w] += step(half_count_column(w));
  int k = first_amplitude();
  for (AcceptedEffect a : accepted) {
    bool known = true;
    for (std::size_t j = 0; j < a.value.size(); ++j, ++k) {
      const Effect::Amplitude& bounds = a.effect->amplitudes[j];
      a.value[j] =
          unknown[k] ? 0.0 : std::clamp(a.value[j] + (step.allFinite() ? step(k) : 0.0), bounds.low, bounds.high);
      known = known && !unknown[k];
    }
    if (known || !a.effect->of_one_recording) one.accepted.push_back(a);
  }
  const auto keep = [run](auto& into, const auto& of) { into = {of[static_cast<std::size_t>(run)]}; };
  keep(one.runs_, runs_);
  keep(one.numbers_, numbers_);
  keep(one.from_commands_, from_commands_);
  keep(one.masked_, masked_);
  keep(one.clock_s, clock_s);
  keep(one.clock_active, clock_active);
  keep(one.views_, views_);
  keep(one.read_views_, read_views_);
  keep(one.linear_, linear_);
  one.linearise();
  return one;
}

// Over one window: the truth's error at both ends, that of its heading at the start swinging the way about, and the
// wheels' errors, which turn the rest of the way.
void add_noise(JointModel::GatheredError& sum, const FittedNoise& noise, double wheelbase_m, const Track& guess,
               double from_s, double to_s) {
  double left_and_right_m = 0.0;
  const auto from =
      std::lower_bound(guess.begin(), guess.end(), from_s, [](const TimedPose& p, double t) { return p.time_s < t; });
  const auto to = std::lower_bound(from, guess.end(), to_s, [](const TimedPose& p, double t) { return p.time_s < t; });
  if (from == guess.end() || from == to) return;
  for (auto i = from; i + 1 < guess.end() && i < to; ++i) {
    const double way = length((i + 1)->pose.position() - i->pose.position());
    const double turned = 0.5 * wheelbase_m * std::abs((i + 1)->pose.heading_rad - i->pose.heading_rad);
    left_and_right_m += 2.0 * std::max(way, turned);
  }
  const Vec2 along = std::min(to, guess.end() - 1)->pose.position() - from->pose.position();
  const double q2 = noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m,
               p2 = noise.truth_position_m * noise.truth_position_m,
               h2 = noise.truth_heading_rad * noise.truth_heading_rad,
               body2 = noise.body_m_per_sqrt_m * noise.body_m_per_sqrt_m,
               side2 = noise.sideways_m_per_sqrt_m * noise.sideways_m_per_sqrt_m;
  const double turn2 = (q2 + 2.0 * body2) * left_and_right_m / (wheelbase_m * wheelbase_m), d2 = dot(along, along);
  sum.noise_position_m2 +=
      4.0 * p2 + h2 * d2 + (0.25 * q2 + 0.5 * (body2 + side2)) * left_and_right_m + turn2 * d2 / 3.0;
  sum.noise_heading_rad2 += 2.0 * h2 + turn2;
}

JointModel::GatheredError JointModel::gathered_error() const {
  std::vector<GatheredError> of(runs_.size());
  parallel_for(static_cast<int>(runs_.size()), [&](int r) {
    const InnovationRun& run = linear_[r].run();
    if (!run.truth_has_heading) return;
    Track guess, truth;
    Pose pose;
    for (std::size_t i = 0; i < run.wheels.size(); ++i) {
      guess.push_back({run.wheels[i].time_s + clock_s[r], pose * model.truth.axle_T_tracked});
      if (i + 1 == run.wheels.size()) break;
      const double left = model.drive.wheel_radius_left_m * (run.wheels[i + 1].left_rad - run.wheels[i].left_rad);
      const double right = model.drive.wheel_radius_right_m * (run.wheels[i + 1].right_rad - run.wheels[i].right_rad);
      double f = 0.5 * (left + right), l = 0.0, w = (right - left) / model.drive.wheelbase_m;
      for (const ExtraColumn& e : run.extra) {
        f += e.per_step[i].forward_m;
        l += e.per_step[i].sideways_m;
        w += e.per_step[i].turn_rad;
      }
      const double h = pose.heading_rad + 0.5 * w, c = std::cos(h), s = std::sin(h);
      pose = {pose.x_m + f * c - l * s, pose.y_m + f * s + l * c, pose.heading_rad + w};
    }
    for (std::size_t i = 0; i < run.truth.size(); ++i)
      if (!run.set_aside[i] && run.truth[i].heading_rad)
        truth.push_back(
            {run.truth[i].time_s, {run.truth[i].position.x_m, run.truth[i].position.y_m, *run.truth[i].heading_rad}});
    if (const std::optional<TrackError> e = track_error(guess, truth); e && e->windows > 0) {
      of[r].position_m2 = e->windows * e->position_rms_m * e->position_rms_m;
      of[r].heading_rad2 = e->windows * e->heading_rms_rad * e->heading_rms_rad;
      of[r].windows = e->windows;
      for (const auto& [from_s, to_s] : e->window_s)
        add_noise(of[r], model.noise, model.drive.wheelbase_m, guess, from_s, to_s);
    }
  });
  GatheredError sum;
  for (const GatheredError& e : of) {
    sum.position_m2 += e.position_m2;
    sum.heading_rad2 += e.heading_rad2;
    sum.noise_position_m2 += e.noise_position_m2;
    sum.noise_heading_rad2 += e.noise_heading_rad2;
    sum.windows += e.windows;
  }
  if (sum.windows > 0)
    for (double* mean : {&sum.position_m2, &sum.heading_rad2, &sum.noise_position_m2, &sum.noise_heading_rad2})
      *mean /= sum.windows;
  return sum;
}

// Correlation of each whitened innovation with that before, the largest of the three channels. That of a floor whose
// unevenness has a length is negative, since the noise was fitted to what adds up. Samples between the same two
// readings of the encoders share their rounding and say nothing of the model: "before" is a reading and a half ago.
bool JointModel::innovations_correlated() const {
  constexpr double kReadings = 1.5;
  double product[3] = {}, square[3] = {};
  for (std::size_t run = 0; run < linear_.size(); ++run) {
    const Whitened& r = linear_[run].residual();
    const auto period_s = [](const auto& samples) {
      return (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
    };
    const double apart = kReadings * period_s(runs_[run].wheels) / period_s(runs_[run].truth);
    const std::size_t lag = 3 * static_cast<std::size_t>(std::clamp(apart, 1.0, 100.0));
    for (std::size_t i = lag; i < r.size(); ++i) {
      product[i % 3] += r[i] * r[i - lag];
      square[i % 3] += r[i] * r[i];
    }
  }
  for (int k = 0; k < 3; ++k)
    if (product[k] > 0.12 * square[k]) return true;
  return false;
}

Track JointModel::poses(int run) const {
  Track track;
  for (const FilterStep& s : linear_[run].steps())
    if (s.truth_index >= 0) track.push_back({runs_[run].truth[s.truth_index].time_s - clock_s[run], s.pose});
  return track;
}

CandidateColumns JointModel::columns_of(const Effect& effect, const std::vector<double>& shape) const {
  CandidateColumns out;
  out.of_run.resize(runs_.size());
  out.stretch.resize(runs_.size());
  std::vector<double> buffer;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (effect.of_one_recording && static_cast<int>(shape[0]) != static_cast<int>(r)) continue;
    const int n = linear_[r].samples(), k = static_cast<int>(effect.amplitudes.size());
    buffer.resize(3 * static_cast<std::size_t>(n));
    if (effect.clock_rate) {
      linear_[r].of_clock_rate(buffer.data());
      out.stretch[r] = {0, n};
      out.of_run[r] = Eigen::Map<VectorXd>(buffer.data(), 3 * n);
      continue;
    }
    const std::vector<Motions> motions = effect.motions(views_[r], shape);
    std::vector<Stretch> parts(k);
    std::vector<VectorXd> made(k);
    Stretch all{n, 0};
    for (int j = 0; j < k; ++j) {
      parts[j] = linear_[r].of_motion(motions[j], buffer.data());
      const int rows = 3 * (parts[j].last - parts[j].first);
      if (rows <= 0) continue;
      made[j] = Eigen::Map<VectorXd>(buffer.data() + 3 * parts[j].first, rows);
      all = {std::min(all.first, parts[j].first), std::max(all.last, parts[j].last)};
    }
    if (all.last <= all.first) continue;
    out.stretch[r] = all;
    out.of_run[r] = MatrixXd::Zero(3 * (all.last - all.first), k);
    for (int j = 0; j < k; ++j)
      if (made[j].size() > 0) out.of_run[r].col(j).segment(3 * (parts[j].first - all.first), made[j].size()) = made[j];
  }
  return out;
}

CandidateTest JointModel::test(const CandidateColumns& c, int without, bool thorough) const {
  CandidateTest out;
  int k = 0;
  for (const MatrixXd& m : c.of_run) k = std::max(k, static_cast<int>(m.cols()));
  out.freedom = k;
  if (k == 0) return out;
  const int q = static_cast<int>(gram_.rows());
  // Columns that stay, and those of the effect that is taken out.
  std::vector<int> kept, removed;
  VectorXd taken = VectorXd::Zero(q);
  {
    int at = first_amplitude();
    for (int j = 0; j < at; ++j) kept.push_back(j);
    for (std::size_t a = 0; a < accepted.size(); ++a)
      for (double v : accepted[a].value) {
        if (static_cast<int>(a) == without) {
          removed.push_back(at);
          taken(at) = v;
        } else {
          kept.push_back(at);
        }
        ++at;
      }
  }
  MatrixXd info = MatrixXd::Zero(k, k), cross = MatrixXd::Zero(q, k);
  VectorXd score = VectorXd::Zero(k);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (c.of_run[r].size() == 0) continue;
    const auto rows = c.of_run[r].rows(), from = static_cast<Eigen::Index>(3 * c.stretch[r].first);
    info.noalias() += c.of_run[r].transpose() * c.of_run[r];
    cross.noalias() += z_[r].middleRows(from, rows).transpose() * c.of_run[r];
    score.noalias() += c.of_run[r].transpose() * residual_[r].segment(from, rows);
  }
  score += cross.transpose() * taken;
  const VectorXd zr = zr_ + gram_ * taken;
  MatrixXd gram(kept.size(), kept.size()), b(kept.size(), k);
  VectorXd zk(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t j = 0; j < kept.size(); ++j) gram(i, j) = gram_(kept[i], kept[j]);
    b.row(i) = cross.row(kept[i]);
    zk(i) = zr(kept[i]);
  }
  const Eigen::LDLT<MatrixXd> solver(gram);
  const MatrixXd beta = solver.solve(b);  // the part that calibration absorbs
  const VectorXd base = solver.solve(zk);
  const MatrixXd effective = info - b.transpose() * beta;
  const VectorXd s = score - b.transpose() * base;
  if (info.trace() <= 0.0) return out;
  out.survives = 1.0;
  for (int j = 0; j < k; ++j)
    out.survives = std::min(out.survives, info(j, j) > 0.0 ? effective(j, j) / info(j, j) : 0.0);
  // Directions that do not survive are left out of the test.
  VectorXd scale(k);
  for (int j = 0; j < k; ++j) scale(j) = info(j, j) > 0.0 ? 1.0 / std::sqrt(info(j, j)) : 0.0;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(scale.asDiagonal() * effective * scale.asDiagonal());
  const VectorXd su = eig.eigenvectors().transpose() * (scale.asDiagonal() * s);
  VectorXd w = VectorXd::Zero(k);
  MatrixXd cov = MatrixXd::Zero(k, k);
  int freedom = 0;
  for (int j = 0; j < k; ++j) {
    const double e = eig.eigenvalues()(j);
    if (e < c.least_surviving) {
      cov += 1e6 * eig.eigenvectors().col(j) * eig.eigenvectors().col(j).transpose();
      continue;
    }
    ++freedom;
    w += su(j) / e * eig.eigenvectors().col(j);
    cov += eig.eigenvectors().col(j) * eig.eigenvectors().col(j).transpose() / e;
    out.statistic += su(j) * su(j) / e;
  }
  out.freedom = std::max(1, freedom);
  const VectorXd value = scale.asDiagonal() * w;
  out.value.assign(value.data(), value.data() + k);
  for (int j = 0; j < k; ++j) out.stderr_value.push_back(scale(j) * std::sqrt(cov(j, j)));
  if (!thorough || out.statistic <= 0.0) return out;

  // The score along the fitted direction, batch by batch.
  const VectorXd on_z_kept = beta * value;
  VectorXd on_z = VectorXd::Zero(q);
  for (std::size_t i = 0; i < kept.size(); ++i) on_z(kept[i]) = on_z_kept(static_cast<Eigen::Index>(i));
  VectorXd base_z = -taken;  // residual = r + Z taken - Z_kept base
  for (std::size_t i = 0; i < kept.size(); ++i) base_z(kept[i]) += base(static_cast<Eigen::Index>(i));
  int samples = 0;
  for (const LinearisedRun& l : linear_) samples += l.samples();
  const int batch = std::max(1, samples / kBatches);
  std::vector<double> u, i;
  double square_all = 0.0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    VectorXd column = -(z_[r] * on_z);
    if (c.of_run[r].size() > 0)
      column.segment(3 * c.stretch[r].first, c.of_run[r].rows()).noalias() += c.of_run[r] * value;
    const VectorXd res = residual_[r] - z_[r] * base_z;
    const int n = linear_[r].samples();
    for (int from = 0; from < n; from += batch) {
      const int rows = 3 * (std::min(n, from + batch) - from);
      u.push_back(column.segment(3 * from, rows).dot(res.segment(3 * from, rows)));
      i.push_back(column.segment(3 * from, rows).squaredNorm());
      square_all += i.back() * i.back();
    }
  }
  double sum_u = 0.0, sum_i = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) sum_u += u[n], sum_i += i[n];
  if (sum_i <= 0.0) return out;
  const double a = sum_u / sum_i;
  double scatter = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) scatter += (u[n] - a * i[n]) * (u[n] - a * i[n]);
  const double count = sum_i * sum_i / std::max(square_all, 1e-300);  // batches that matter
  out.inflation = shrunk_inflation(scatter / sum_i, count);
  out.batches = kPriorBatches + count;
  if (count < kFewestToValidate) {  // a single kick of a castor is not fitted on one half and tried on the other
    out.cross_validated = out.statistic;
    return out;
  }
  for (int half = 0; half < 2; ++half) {
    double fu = 0.0, fi = 0.0, tu = 0.0, ti = 0.0;
    for (std::size_t n = 0; n < u.size(); ++n)
      (static_cast<int>(n % 2) == half ? fu : tu) += u[n], (static_cast<int>(n % 2) == half ? fi : ti) += i[n];
    if (fi <= 0.0) continue;
    const double fitted = fu / fi;
    out.cross_validated += 2.0 * fitted * tu - fitted * fitted * ti;
  }
  return out;
}

std::vector<BodyMotion> JointModel::score_of_motions(int run) const {
  const VectorXd left = residual_[run] - z_[run] * gram_.ldlt().solve(zr_);
  return linear_[run].score_of_motions(left.data());
}

}  // namespace odolab
