// What a small change of the joint model does to what it leaves: a column for each of its numbers.
#include <utility>

#include "core/base/parallel.h"
#include "core/diagnosis/model/counts_at_rest.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGrowth = 1e-3;  // what lags is linear in what was told

// The drive as it would be told with a radius, or the wheelbase, larger by that share. It goes where it went: whether
// it stood at first does not hang on what its lengths are believed to be.
DriveView grown_by(int length, DriveView view) {
  for (EffectStep& s : view.steps) {
    const double left_m = s.told_left_m(), right_m = s.told_right_m(), turn_rad = s.told_turn_rad();
    s.left_m = length == column::wheel_radius_left ? (1.0 + kGrowth) * left_m : left_m;
    s.right_m = length == column::wheel_radius_right ? (1.0 + kGrowth) * right_m : right_m;
    const double more_rad = (s.right_m - right_m - (s.left_m - left_m)) / view.drive.wheelbase_m;
    s.turn_rad = turn_rad + (length == column::wheelbase ? -kGrowth * turn_rad : more_rad);
    s.late_left_m = s.late_right_m = s.late_turn_rad = 0.0;
  }
  return view;
}

// What a base goes further with a radius or a wheelbase comes as late as all that it goes.
void add_lagging(const AcceptedEffect& lag, const DriveView& view, const LinearisedRun& linear,
                 const std::array<double*, column::first_extra>& of_parameters) {
  const DifferentialDrive& d = view.drive;
  const Motions as_it_is = lag.effect->motions(view, lag.shape).front();
  for (const auto& [length, size_m] : {std::pair<int, double>{column::wheel_radius_left, d.wheel_radius_left_m},
                                       {column::wheel_radius_right, d.wheel_radius_right_m},
                                       {column::wheelbase, d.wheelbase_m}}) {
    double* const out = of_parameters[static_cast<std::size_t>(length)];
    if (!out) continue;
    std::vector<double> behind(static_cast<std::size_t>(3 * linear.samples()), 0.0);
    Motions more = lag.effect->motions(grown_by(length, view), lag.shape).front();
    as_it_is.add_to(more, -1.0);
    linear.of_motion(more, behind.data());
    for (std::size_t i = 0; i < behind.size(); ++i) out[i] += lag.value[0] / (kGrowth * size_m) * behind[i];
  }
}

}  // namespace

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
               noise.wander_lasts_s,
               noise.command_timing_s,
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
  forget_what_was_asked();
  std::vector<std::vector<LinearisedRun>> made(n);
  const int q = columns();
  parallel_for(n, [&](int r) {
    const InnovationModel m = model_of(r);
    const auto places_from = [&](const LinearisedRun& of) {
      if (!track[r].empty()) return;
      const TwoClocks own = clocks(r);
      for (const FilterStep& s : of.steps())
        if (s.truth_index >= 0) track[r].push_back({own.wheels_stamp_s(runs_[r].truth[s.truth_index].time_s), s.pose});
    };
    if (accepted.empty()) {  // nothing asks where it is
      made[r].emplace_back(prepared(r, runs_[r], {}), m, with_columns);
      places_from(made[r][0]);
    } else if (track[r].empty()) {
      places_from(LinearisedRun(runs_[r], m, false));
    }
    const auto view = [&](Way way) {
      return as_it_goes(drive_view(numbers_[r], runs_[r], m.drive, from_commands_[r] != 0, track[r], way));
    };
    if (with_columns) next->views[r] = view(Way::smoothed);
    if (!accepted.empty()) {
      next->read_views[r] = with_columns ? as_read(next->views[r], runs_[r]) : view(Way::as_read);
      made[r].emplace_back(prepared(r, runs_[r], next->read_views[r]), m, with_columns);
    }
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
    for (const AcceptedEffect& a : accepted)
      if (a.effect->lags_behind_commands() && from_commands_[r] != 0)
        add_lagging(a, next->views[r], linear, of_parameters);
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

std::array<double, 6> JointModel::sizes_of_priors() const {
  const DifferentialDrive& d = std::get<DifferentialDrive>(nominal_.kind);
  return {0.1 * d.wheel_radius_left_m, 0.1 * d.wheel_radius_right_m, 0.1 * d.wheelbase_m, 0.2, 0.2, 0.3};
}

// What a mean radius that is known to its prior would say of both.
Eigen::Matrix2d JointModel::of_mean_radius() const {
  const std::array<double, 6> size = sizes_of_priors();
  const Eigen::Vector2d share(0.5 / size[0], 0.5 / size[1]);
  return share * share.transpose();
}

void JointModel::add_priors() {
  const std::array<double, 6> size = sizes_of_priors();
  InnovationModel nominal{std::get<DifferentialDrive>(nominal_.kind), nominal_.truth, {}}, now = model;
  for (int c = 0; c < 6; ++c) {
    gram_(c, c) += 1.0 / (size[c] * size[c]);
    zr_(c) += nuisance_active[c] ? (nuisance(nominal, c) - nuisance(now, c)) / (size[c] * size[c]) : 0.0;
  }
  if (mean_radius_is_held_) {
    double off = 0.0;
    for (int c : {0, 1}) off += 0.5 * (nuisance(nominal, c) - nuisance(now, c)) / size[c];
    gram_.topLeftCorner<2, 2>() += kMeanRadiusHeld * of_mean_radius();
    for (int c : {0, 1}) zr_(c) += nuisance_active[c] ? kMeanRadiusHeld * 0.5 / size[c] * off : 0.0;
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

}  // namespace odolab
