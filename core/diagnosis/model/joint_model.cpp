#include "core/diagnosis/model/joint_model.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/calibration/left_out.h"
#include "core/calibration/noise_fit.h"
#include "core/calibration/restamped.h"
#include "core/diagnosis/model/counts_at_rest.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

double& JointModel::nuisance(InnovationModel& m, int c) {
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

JointModel::JointModel(std::vector<InnovationRun> runs, std::vector<char> from_commands,
                       const LeastSquaresCalibration& start, const Vehicle& nominal)
    : runs_(std::move(runs)), from_commands_(std::move(from_commands)), nominal_(nominal) {
  model.drive = std::get<DifferentialDrive>(start.vehicle.kind);
  model.truth = start.vehicle.truth;
  model.noise = start.noise;
  if (model.noise.truth_heading_rad <= 0.0) model.noise.truth_heading_rad = 0.01;
  model.noise = with_wander(with_body(model.noise));
  clock_s = start.time_offset_s;
  clock_s.resize(runs_.size(), model.truth.time_offset_s);
  clock_active.assign(runs_.size(), 1);
  for (const InnovationRun& run : runs_) masked_.push_back(run.set_aside);
  cut();
  for (std::size_t r = 0; r < runs_.size(); ++r) numbers_.push_back(static_cast<int>(r));
}

void JointModel::cut() {
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const std::vector<char> before = runs_[r].cut;
    cut_where_left_out(runs_[r], clock_s[r]);
    if (runs_[r].cut != before) linearised_at_.reset();
  }
}

bool JointModel::is_well_inside(int r, double time_s) const {
  constexpr std::ptrdiff_t kFew = 3;
  constexpr double kNear_s = 0.1;
  const InnovationRun& run = runs_[static_cast<std::size_t>(r)];
  const double on_truths_clock_s = time_s + clock_s[static_cast<std::size_t>(r)];
  const auto n = static_cast<std::ptrdiff_t>(run.truth.size());
  const std::ptrdiff_t behind = std::lower_bound(run.truth.begin(), run.truth.end(), on_truths_clock_s,
                                                 [](const TruthSample& t, double s) { return t.time_s < s; }) -
                                run.truth.begin();
  const auto enough = [&](std::ptrdiff_t samples, double at_s) {
    return samples >= kFew && std::abs(at_s - on_truths_clock_s) >= kNear_s;
  };
  std::ptrdiff_t k = behind;
  for (;; ++k) {
    if (k >= n || is_cut(run, static_cast<std::size_t>(k))) return false;
    if (enough(k - behind + 1, run.truth[static_cast<std::size_t>(k)].time_s)) break;
  }
  for (k = behind - 1;; --k) {
    if (k < 0) return false;
    if (enough(behind - k, run.truth[static_cast<std::size_t>(k)].time_s)) return true;
    if (is_cut(run, static_cast<std::size_t>(k))) return false;
  }
}

InnovationModel JointModel::model_of(int run) const {
  InnovationModel m = model;
  m.truth.time_offset_s = clock_s[run];
  return m;
}

InnovationRun JointModel::prepared(int r) const { return prepared(r, runs_[r], now_->read_views[r]); }

InnovationRun JointModel::prepared(int r, const InnovationRun& of, const DriveView& view) const {
  InnovationRun run = of;
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
    const std::array<Motions, 2> of_wheel = counts_at_rest(of, model.drive);
    for (int k = 0; k < 2; ++k) of_wheel[k].add_to(sum.per_step, half_counts[k]);
    any = true;
  }
  for (const AcceptedEffect& a : accepted) {
    if (a.effect->clock_rate) {
      put_clock_right(run, a.value[a.effect->clock_amplitude(numbers_[r])], clock_s[r]);
      continue;
    }
    const std::vector<Motions> motions = a.effect->motions(view, a.shape);
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

VectorXd JointModel::Linearisation::acting(std::size_t run, const VectorXd& of_all) const {
  VectorXd out(static_cast<Eigen::Index>(columns[run].size()));
  for (std::size_t c = 0; c < columns[run].size(); ++c) out(static_cast<Eigen::Index>(c)) = of_all(columns[run][c]);
  return out;
}

JointModel::Standing JointModel::standing() const {
  Standing s;
  const DifferentialDrive& d = model.drive;
  const Pose& mounting = model.truth.axle_T_tracked;
  const FittedNoise& noise = model.noise;
  s.numbers = {d.wheel_radius_left_m,
               d.wheel_radius_right_m,
               d.wheelbase_m,
               mounting.x_m,
               mounting.y_m,
               mounting.heading_rad,
               noise.wheel_m_per_sqrt_m,
               noise.truth_position_m,
               noise.truth_heading_rad,
               noise.along_m_per_sqrt_m,
               noise.turning_m_per_sqrt_m,
               noise.sideways_m_per_sqrt_m,
               noise.wander_m_per_sqrt_s,
               noise.heading_wander_rad_per_sqrt_s,
               half_counts[0],
               half_counts[1]};
  const auto append = [](auto& to, const auto& of) { to.insert(to.end(), of.begin(), of.end()); };
  append(s.numbers, clock_s);
  for (const AcceptedEffect& a : accepted) {
    s.effects.push_back(a.effect);
    append(s.numbers, a.shape);
    append(s.numbers, a.value);
  }
  append(s.active, nuisance_active);
  append(s.active, clock_active);
  return s;
}

void JointModel::linearise(bool with_columns) {
  const Standing here = standing();
  if (linearised_at_ == here && (has_columns_ || !with_columns)) return;
  // Where effects act is known once a pass that has them in it has said where the vehicle was.
  if (now_ || accepted.empty())
    linearised_at_ = here;
  else
    linearised_at_.reset();
  has_columns_ = with_columns;
  const int n = static_cast<int>(runs_.size());
  std::vector<Track> track(n);
  if (now_)
    for (int r = 0; r < n; ++r) track[r] = poses(r);
  const auto next = std::make_shared<Linearisation>();
  next->views.resize(n);
  next->read_views.resize(n);
  next->columns.resize(n);
  next->z.resize(n);
  residual_.resize(n);
  scanned_.reset();
  std::vector<std::vector<LinearisedRun>> made(n);
  const int q = columns();
  parallel_for(n, [&](int r) {
    const InnovationModel m = model_of(r);
    if (track[r].empty()) {  // the places come from the filter itself
      LinearisedRun first(runs_[r], m);
      for (const FilterStep& s : first.steps())
        if (s.truth_index >= 0) track[r].push_back({runs_[r].truth[s.truth_index].time_s - clock_s[r], s.pose});
    }
    if (with_columns)
      next->views[r] = drive_view(numbers_[r], runs_[r], m.drive, from_commands_[r] != 0, track[r], Way::smoothed);
    if (!accepted.empty())
      next->read_views[r] =
          with_columns ? as_read(next->views[r], runs_[r])
                       : drive_view(numbers_[r], runs_[r], m.drive, from_commands_[r] != 0, track[r], Way::as_read);
    made[r].emplace_back(prepared(r, runs_[r], next->read_views[r]), m);
    const LinearisedRun& linear = made[r][0];
    const int rows = 3 * linear.samples();
    residual_[r] = Eigen::Map<const VectorXd>(linear.residual().data(), rows);
    if (!with_columns) return;
    // First which columns act, then these.
    std::vector<int>& acting = next->columns[r];
    for (int c = 0; c < 6; ++c)
      if (nuisance_active[c]) acting.push_back(c);
    if (clock_active[r]) acting.push_back(clock_column(r));
    if (runs_[r].counts_show)
      for (int k = 0; k < 2; ++k) acting.push_back(half_count_column(k));
    std::vector<Motions> of_effects;
    int column = first_amplitude();
    for (const AcceptedEffect& a : accepted) {
      if (a.effect->clock_rate) {
        acting.push_back(column + static_cast<int>(a.effect->clock_amplitude(numbers_[r])));
        of_effects.emplace_back();
        column += static_cast<int>(a.value.size());
        continue;
      }
      for (Motions& m_k : a.effect->motions(next->views[r], a.shape)) {
        if (!m_k.empty()) {
          acting.push_back(column);
          of_effects.push_back(std::move(m_k));
        }
        ++column;
      }
    }
    MatrixXd& z = next->z[r];
    z = MatrixXd::Zero(rows, static_cast<Eigen::Index>(acting.size()));
    Eigen::Index at = 0;
    std::array<double*, column::first_extra> of_parameters{};
    for (int c = 0; c < 6; ++c)
      if (nuisance_active[c]) of_parameters[static_cast<std::size_t>(c)] = z.col(at++).data();
    if (clock_active[r]) of_parameters[column::truth_clock] = z.col(at++).data();
    linear.of_parameters(of_parameters);
    if (runs_[r].counts_show)
      for (const Motions& of_wheel : counts_at_rest(runs_[r], model.drive))
        linear.of_motion(of_wheel, z.col(at++).data());
    for (const Motions& motions : of_effects) {
      if (motions.empty())
        linear.of_clock_rate(z.col(at++).data());
      else
        linear.of_motion(motions, z.col(at++).data());
    }
  });
  for (auto& one : made) next->runs.push_back(std::move(one[0]));
  now_ = next;
  gram_ = MatrixXd::Zero(q, q);
  zr_ = VectorXd::Zero(q);
  chi2_ = log_determinant_ = 0.0;
  scalars_ = 0;
  for (int r = 0; r < n; ++r) {
    add_products(r, gram_, zr_);
    chi2_ += now_->runs[r].sums().chi2;
    log_determinant_ += now_->runs[r].sums().log_determinant;
    scalars_ += now_->runs[r].sums().scalars;
  }
  add_priors();
}

void JointModel::add_priors() {
  const DifferentialDrive& d = std::get<DifferentialDrive>(nominal_.kind);
  const double size[6] = {
      0.1 * d.wheel_radius_left_m, 0.1 * d.wheel_radius_right_m, 0.1 * d.wheelbase_m, 0.2, 0.2, 0.3};
  InnovationModel nominal{d, nominal_.truth, {}}, now = model;
  for (int c = 0; c < 6; ++c) {
    gram_(c, c) += 1.0 / (size[c] * size[c]);
    zr_(c) += nuisance_active[c] ? (nuisance(nominal, c) - nuisance(now, c)) / (size[c] * size[c]) : 0.0;
  }
  for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
    gram_(6 + r, 6 + r) += 25.0;
    zr_(6 + r) += clock_active[r] ? 25.0 * (nominal_.truth.time_offset_s - clock_s[r]) : 0.0;
  }
  for (int k = 0; k < 2; ++k) {  // a share between none and all
    gram_(half_count_column(k), half_count_column(k)) += 1.0;
    zr_(half_count_column(k)) -= half_counts[k];
  }
  for (int k = first_amplitude(); k < columns(); ++k) gram_(k, k) += 1e-12;
}

void JointModel::add_products(int run, MatrixXd& gram, VectorXd& zr) const {
  const std::vector<int>& acting = now_->columns[run];
  const MatrixXd& z = now_->z[run];
  if (z.size() == 0) return;
  const MatrixXd own = z.transpose() * z;
  const VectorXd with_residual = z.transpose() * residual_[run];
  for (std::size_t i = 0; i < acting.size(); ++i) {
    for (std::size_t j = 0; j < acting.size(); ++j)
      gram(acting[i], acting[j]) += own(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    zr(acting[i]) += with_residual(static_cast<Eigen::Index>(i));
  }
}

double JointModel::fit(int iterations) {
  constexpr double kNothing = 1e-4;  // a hundredth of a standard deviation
  constexpr double kStraight = 0.1;  // a third: over so little the model is linear
  const bool shapes_follow = std::any_of(accepted.begin(), accepted.end(), [](const AcceptedEffect& a) {
    return a.effect->shape_follows_amplitude && !a.is_held;
  });
  const std::vector<int> held = held_columns();
  linearise();
  double gained = 0.0;
  for (int i = 0; i < iterations; ++i) {
    MatrixXd gram = gram_;
    VectorXd moved_by = zr_;
    for (int c : held) {
      gram.row(c).setZero();
      gram.col(c).setZero();
      gram(c, c) = 1.0;
      moved_by(c) = 0.0;
    }
    const VectorXd step = gram.ldlt().solve(moved_by), score = zr_;
    if (!step.allFinite()) break;
    const double size = step.dot(score);
    if (size < kNothing && !shapes_follow) break;
    const auto saved_accepted = accepted;
    const InnovationModel saved = model;
    const std::vector<double> saved_clock = clock_s;
    const std::array<double, 2> saved_half_counts = half_counts;
    const double before = chi2_;
    VectorXd gone;
    double scale = 1.0;
    const auto go = [&] {
      gone = scale * step;
      model = saved;
      clock_s = saved_clock;
      accepted = saved_accepted;
      for (int c = 0; c < 6; ++c) nuisance(model, c) += scale * step(c);
      for (std::size_t r = 0; r < runs_.size(); ++r) clock_s[r] += scale * step(6 + r);
      for (int w = 0; w < 2; ++w) half_counts[w] = saved_half_counts[w] + scale * step(half_count_column(w));
      int k = first_amplitude();
      for (AcceptedEffect& a : accepted) {
        for (std::size_t j = 0; j < a.value.size(); ++j, ++k) {
          const double was = a.value[j];
          a.value[j] = std::clamp(was + scale * step(k), a.effect->amplitudes[j].low, a.effect->amplitudes[j].high);
          gone(k) = a.value[j] - was;
        }
        if (a.effect->shape_follows_amplitude && !a.is_held) a.shape[0] = std::max(0.5 * (a.shape[0] + a.value[0]), 1e-4);
      }
    };
    if (size < kStraight && !shapes_follow) {
      go();
      for (std::size_t r = 0; r < runs_.size(); ++r) residual_[r] -= now_->z[r] * now_->acting(r, gone);
      scanned_.reset();
      zr_ -= gram_ * gone;
      gained += gone.dot(score + zr_);
      chi2_ -= gone.dot(score + zr_);
      linearised_at_ = standing();
      break;
    }
    for (int attempt = 0; attempt < 3; ++attempt, scale *= 0.3) {
      go();
      linearise();
      if (std::isfinite(chi2_) && chi2_ < before * 1.02 + 20.0) break;
    }
    gained += gone.dot(score + zr_);
  }
  const MatrixXd cov = covariance();
  int k = first_amplitude();
  for (AcceptedEffect& a : accepted) {
    a.stderr_value.resize(a.value.size());
    for (std::size_t j = 0; j < a.value.size(); ++j, ++k) a.stderr_value[j] = std::sqrt(std::max(0.0, cov(k, k)));
  }
  return gained;
}

double* JointModel::clock_rate_of(int run) {
  for (AcceptedEffect& a : accepted)
    if (a.effect->clock_rate && a.effect->of_each_recording)
      return &a.value[a.effect->clock_amplitude(numbers_[static_cast<std::size_t>(run)])];
  return nullptr;
}

std::vector<int> JointModel::held_columns() const {
  std::vector<int> held;
  for (std::size_t k = 0; k < accepted.size(); ++k)
    if (accepted[k].is_held)
      for (std::size_t j = 0; j < accepted[k].value.size(); ++j)
        held.push_back(first_column(static_cast<int>(k)) + static_cast<int>(j));
  if (!clocks_are_held) return held;
  for (std::size_t r = 0; r < runs_.size(); ++r) held.push_back(clock_column(static_cast<int>(r)));
  for (std::size_t k = 0; k < accepted.size(); ++k)
    if (accepted[k].effect->clock_rate)
      for (std::size_t j = 0; j < accepted[k].value.size(); ++j)
        held.push_back(first_column(static_cast<int>(k)) + static_cast<int>(j));
  return held;
}

double JointModel::minus_two_log_likelihood_of(int r) const {
  const InnovationRun run = prepared(r);
  const InnovationModel m = model_of(r);
  FilterOptions options;
  options.derivatives = false;
  const InnovationSums sums = filtered(run, summed_up(run, m), m, options);
  return sums.chi2 + sums.log_determinant;
}

MatrixXd JointModel::covariance() const { return gram_.ldlt().solve(MatrixXd::Identity(gram_.rows(), gram_.cols())); }

double JointModel::stderr_of_nuisance(int c) const { return std::sqrt(std::max(0.0, covariance()(c, c))); }

int JointModel::first_column(int which) const {
  int n = first_amplitude();
  for (int a = 0; a < which; ++a) n += static_cast<int>(accepted[static_cast<std::size_t>(a)].value.size());
  return n;
}

Track JointModel::poses(int run) const {
  Track track;
  for (const FilterStep& s : now_->runs[run].steps())
    if (s.truth_index >= 0) track.push_back({runs_[run].truth[s.truth_index].time_s - clock_s[run], s.pose});
  return track;
}

}  // namespace odolab
