#include "core/diagnosis/units/geometry_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/base/stamp_digits.h"
#include "core/diagnosis/units/laid_stretch.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kGeometryStretch_m = 0.5,
                 kGeometryStretch_rad = 1.0;   // Eq. 1: so short that the wheels hardly err, beside the truth
constexpr std::size_t kFewestPassed = 4;       // samples of a stretch
constexpr double kShortestTruthStep_s = 0.03;  // truth samples closer together are thinned out
constexpr double kGeometryWheelPrior = 0.1, kGeometryClockPrior_s = 0.2, kHeld = 1e-7;
constexpr double kDeterminedGeometryShare = 0.2;
constexpr double kGeometryHuber = 3.0;
constexpr int kGeometryIterations = 8;
constexpr double kStep = 1e-5;

// Truth samples of one run that a unit passes in one stretch.
struct UnitStretch {
  std::size_t first = 0, last = 0;  // of the thinned truth; the last belongs to it
};

// All unknowns as departures from the file: joints, then left wheel, right wheel and wheelbase of each unit as shares
// and, of a castor, how far its axle lies to the left of its pivot's line, then the clock of each run.
struct Unknowns {
  std::vector<JointParameter> joints;
  int units = 0, runs = 0;
  bool wheels_are_held = false;

  int joint_count() const { return static_cast<int>(joints.size()); }
  int wheel(int unit, int k) const { return joint_count() + 4 * unit + k; }
  int aside(int unit) const { return wheel(unit, 3); }
  int clock(int run) const { return joint_count() + 4 * units + run; }
  int count() const { return joint_count() + 4 * units + runs; }
  double prior(int k) const {
    if (k < joint_count()) return joints[static_cast<std::size_t>(k)].prior;
    if (k < clock(0))
      return wheels_are_held ? kHeld : (k - joint_count()) % 4 == 3 ? kAsidePrior_m : kGeometryWheelPrior;
    return kGeometryClockPrior_s;
  }
};

struct GeometryNormal {
  MatrixXd information, spread;
  VectorXd gradient;
};

GeometryNormal zero(int n) { return {MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), VectorXd::Zero(n)}; }

// One unit in one run.
class Passage {
 public:
  Passage(const JoinedRun& run, const Vehicle& nominal, const Unknowns& unknowns, int run_number, int unit)
      : run_(&run), nominal_(nominal), unknowns_(&unknowns), number_(run_number), unit_(unit) {
    drive_ = units_of(nominal)[static_cast<std::size_t>(unit)].drive;
    for (const TimedPose& t : run.tracked)
      if (tracked_.empty() || t.time_s > tracked_.back().time_s + kShortestTruthStep_s) tracked_.push_back(t);
    cut_into_stretches();
    find_own_joints();
  }

  // The linearised problem about x. `with_spread`: also the covariance of the gradient.
  GeometryNormal normal_at(const VectorXd& x, bool with_spread) const {
    const int n = unknowns_->count();
    GeometryNormal normal = zero(n);
    if (stretches_.empty()) return normal;
    std::vector<Pose> by_wheels;
    const std::vector<Vector3d> residuals = residuals_at(x, measured(), &by_wheels);
    std::vector<MatrixXd> jacobian(residuals.size(), MatrixXd::Zero(3, n));
    for (int k : own_unknowns()) {
      VectorXd more = x, less = x;
      const double step = k >= unknowns_->clock(0) ? clock_step_s() : kStep;
      more[k] += step;
      less[k] -= step;
      const std::vector<Vector3d> up = residuals_at(more, by_wheels), down = residuals_at(less, by_wheels);
      for (std::size_t i = 0; i < residuals.size(); ++i) jacobian[i].col(k) = (up[i] - down[i]) / (2.0 * step);
    }
    const Vector3d sigma = deviations(residuals);
    std::vector<Vector3d> weights;
    std::size_t i = 0;
    for (const UnitStretch& s : stretches_) {
      VectorXd score = VectorXd::Zero(n);
      for (std::size_t k = s.first; k <= s.last; ++k, ++i) {
        Vector3d weight;
        for (int row = 0; row < 3; ++row) {
          const double z = std::abs(residuals[i][row]) / sigma[row];
          weight[row] = (z <= kGeometryHuber ? 1.0 : kGeometryHuber / z) / (sigma[row] * sigma[row]);
        }
        const MatrixXd weighted = jacobian[i].transpose() * weight.asDiagonal();
        normal.information += weighted * jacobian[i];
        score -= weighted * residuals[i];
        weights.push_back(weight);
      }
      normal.gradient += score;
      if (with_spread) normal.spread += score * score.transpose();
    }
    if (with_spread) add_rounding(x, jacobian, weights, normal.spread);
    return normal;
  }

  DifferentialDrive drive_at(const VectorXd& x) const {
    DifferentialDrive drive = drive_;
    drive.wheel_radius_left_m *= 1.0 + x[unknowns_->wheel(unit_, 0)];
    drive.wheel_radius_right_m *= 1.0 + x[unknowns_->wheel(unit_, 1)];
    drive.wheelbase_m *= 1.0 + x[unknowns_->wheel(unit_, 2)];
    return drive;
  }

  // Sum of squares in units of the deviations of another fit.
  double squares_at(const VectorXd& x, const Vector3d& sigma) const {
    double sum = 0.0;
    for (const Vector3d& r : residuals_at(x, measured()))
      for (int k = 0; k < 3; ++k) {
        const double z = std::abs(r[k]) / sigma[k];
        sum += z <= kGeometryHuber ? z * z : kGeometryHuber * (2.0 * z - kGeometryHuber);
      }
    return sum;
  }
  Vector3d deviations_at(const VectorXd& x) const {
    return stretches_.empty() ? Vector3d::Ones() : deviations(residuals_at(x, measured()));
  }

 private:
  // A castor's pivot is no other's.
  void find_own_joints() {
    if (run_->samples.empty()) return;
    const auto axle = [&](const Vehicle& v) {
      return tracked_T_axle(v, static_cast<std::size_t>(unit_), run_->samples.front().joints);
    };
    for (int k = 0; k < unknowns_->joint_count(); ++k) {
      Vehicle moved = nominal_;
      unknowns_->joints[static_cast<std::size_t>(k)].of(moved) += kStep;
      const Pose by = between(axle(nominal_), axle(moved));
      if (by.x_m != 0.0 || by.y_m != 0.0 || by.heading_rad != 0.0) own_joints_.push_back(k);
    }
  }

  std::vector<int> own_unknowns() const {
    std::vector<int> own = own_joints_;
    for (int k = 0; k < 3; ++k) own.push_back(unknowns_->wheel(unit_, k));
    if (std::holds_alternative<MultiCastor>(nominal_.kind)) own.push_back(unknowns_->aside(unit_));
    own.push_back(unknowns_->clock(number_));
    return own;
  }

  // Velocities are taken over a few samples to both sides: those next to a sample share its rounding, and would pull
  // the clock to between the samples, where interpolation smooths the rounding away.
  double clock_step_s() const {
    const std::vector<UnitSample>& samples = run_->samples;
    return 2.5 * (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
  }

  Track wheel_track(const DifferentialDrive& drive) const {
    return way_of(run_->samples, static_cast<std::size_t>(unit_), drive);
  }

  void cut_into_stretches() {
    const Track wheels = wheel_track(drive_);
    std::size_t first = 0, k = 0;
    double travel_m = 0.0, turn_rad = 0.0;
    for (std::size_t i = 1; i < tracked_.size(); ++i) {
      const double at_s = tracked_[i].time_s - nominal_.truth.time_offset_s + kStampDigits_s;
      for (; k + 1 < wheels.size() && wheels[k + 1].time_s <= at_s; ++k) {
        const Pose step = between(wheels[k].pose, wheels[k + 1].pose);
        travel_m += length(step.position());
        turn_rad += std::abs(step.heading_rad);
      }
      if (travel_m < kGeometryStretch_m && turn_rad < kGeometryStretch_rad) continue;
      if (i - first + 1 >= kFewestPassed) stretches_.push_back({first, i});
      first = i + 1;
      travel_m = turn_rad = 0.0;
    }
  }

  struct At {
    Vehicle vehicle;
    Track wheels;
    double offset_s = 0.0;
  };
  At at(const VectorXd& x) const {
    At result{nominal_, {}, 0.0};
    for (int k = 0; k < unknowns_->joint_count(); ++k)
      unknowns_->joints[static_cast<std::size_t>(k)].of(result.vehicle) += x[k];
    move_aside(result.vehicle, static_cast<std::size_t>(unit_), x[unknowns_->aside(unit_)]);
    result.wheels = wheel_track(drive_at(x));
    result.offset_s = nominal_.truth.time_offset_s + x[unknowns_->clock(number_)];
    return result;
  }

  // Eq. 1: where the joints say the axle is, less where the wheels do once their stretch is laid on the other; in the
  // wheels' frame. `tracked`: of each sample. `by_wheels_alone`: gets the tracked point as the wheels have it, so laid.
  // An error of a heading throws what hangs on it to the side, and turns what that place changes with a length just
  // there: with derivatives of poses as measured, each length would come out too short by its square.
  std::vector<Vector3d> residuals_at(const VectorXd& x, const std::vector<Pose>& tracked,
                                     std::vector<Pose>* by_wheels_alone = nullptr) const {
    const At now = at(x);
    std::vector<Vector3d> all;
    if (by_wheels_alone) *by_wheels_alone = tracked;
    for (const UnitStretch& s : stretches_) {
      std::vector<Pose> by_joints, by_wheels, tracked_T_own;
      for (std::size_t k = s.first; k <= s.last; ++k) {
        const double at_s =
            std::clamp(tracked_[k].time_s - now.offset_s, now.wheels.front().time_s, now.wheels.back().time_s);
        tracked_T_own.push_back(
            tracked_T_axle(now.vehicle, static_cast<std::size_t>(unit_), joints_at(run_->samples, at_s)));
        by_joints.push_back(tracked[k] * tracked_T_own.back());
        by_wheels.push_back(*pose_at(now.wheels, at_s));
      }
      const LaidStretch laid = laid_stretch(by_joints, by_wheels);
      all.insert(all.end(), laid.rest.begin(), laid.rest.end());
      for (std::size_t k = 0; k < by_wheels.size() && by_wheels_alone; ++k)
        (*by_wheels_alone)[s.first + k] = laid.joints_T_wheels * by_wheels[k] * inverse(tracked_T_own[k]);
    }
    return all;
  }

  std::vector<Pose> measured() const {
    std::vector<Pose> poses;
    for (const TimedPose& t : tracked_) poses.push_back(t.pose);
    return poses;
  }

  static Vector3d deviations(const std::vector<Vector3d>& residuals) {
    Vector3d result;
    for (int k = 0; k < 3; ++k) {
      std::vector<double> of_one;
      for (const Vector3d& r : residuals) of_one.push_back(r[k]);
      result[k] = std::max(scatter_about_zero(std::move(of_one)), 1e-6);
    }
    return result;
  }

  // Units that hold an angle hold its rounding: all readings within one step of an encoder may err alike.
  void add_rounding(const VectorXd& x, const std::vector<MatrixXd>& jacobian, const std::vector<Vector3d>& weights,
                    MatrixXd& spread) const {
    const At now = at(x);
    const std::vector<double> steps = joint_steps(nominal_);
    for (std::size_t j = 0; j < steps.size(); ++j) {
      if (steps[j] <= 0.0) continue;
      std::map<long long, VectorXd> by_step;
      std::size_t i = 0;
      for (const UnitStretch& s : stretches_)
        for (std::size_t k = s.first; k <= s.last; ++k, ++i) {
          std::vector<double> joints = joints_at(run_->samples, tracked_[k].time_s - now.offset_s);
          const long long step = std::llround(joints[j] / steps[j]);
          const Pose here = tracked_T_axle(now.vehicle, static_cast<std::size_t>(unit_), joints);
          joints[j] += kStep;
          const Pose moved = between(here, tracked_T_axle(now.vehicle, static_cast<std::size_t>(unit_), joints));
          const Vector3d by = Vector3d{moved.x_m, moved.y_m, moved.heading_rad} / kStep;
          const VectorXd effect = jacobian[i].transpose() * weights[i].cwiseProduct(by);
          const auto [entry, is_new] = by_step.emplace(step, effect);
          if (!is_new) entry->second += effect;
        }
      for (const auto& [number, effect] : by_step) spread += steps[j] * steps[j] / 12.0 * effect * effect.transpose();
    }
  }

  const JoinedRun* run_;
  Vehicle nominal_;
  const Unknowns* unknowns_;
  int number_, unit_;
  DifferentialDrive drive_;
  Track tracked_;
  std::vector<UnitStretch> stretches_;
  std::vector<int> own_joints_;
};

GeometryNormal sum_of_passages(const std::vector<Passage>& passages, const VectorXd& x, bool with_spread) {
  std::vector<GeometryNormal> parts(passages.size());
  parallel_for(static_cast<int>(passages.size()), [&](int i) {
    parts[static_cast<std::size_t>(i)] = passages[static_cast<std::size_t>(i)].normal_at(x, with_spread);
  });
  GeometryNormal sum = zero(static_cast<int>(x.size()));
  for (const GeometryNormal& one : parts) {
    sum.information += one.information;
    sum.spread += one.spread;
    sum.gradient += one.gradient;
  }
  return sum;
}

// The body of a platform is where its pivots are: were all of them elsewhere, or turned, the truth's mounting would be.
// Without a truth to measure by, nor would anything tell that all are further apart.
void hold_the_body(const Vehicle& nominal, const Unknowns& unknowns, MatrixXd& of_prior) {
  const auto* platform = std::get_if<MultiCastor>(&nominal.kind);
  if (!platform) return;
  constexpr double kHeld_m = 1e-6;
  std::vector<std::string> names;
  bool mounting = false;
  for (const JointParameter& joint : unknowns.joints) {
    names.push_back(joint.name);
    mounting = mounting || joint.component == "truth";
  }
  MatrixXd held = MatrixXd::Zero(4, unknowns.count());
  held.leftCols(unknowns.joint_count()) = moved_bodies(*platform, names);
  if (mounting) held.row(3).setZero();
  of_prior += held.transpose() * held / (kHeld_m * kHeld_m);
}

// One run as a fit to others sees it; its clock is its own.
double squares_of_run(const JoinedRun& run, const GeometryFit& fit, double clock_s, std::vector<Vector3d>& sigma) {
  Unknowns none;
  none.units = static_cast<int>(fit.drives.size());
  none.runs = 1;
  VectorXd x = VectorXd::Zero(none.count());
  x[none.clock(0)] = clock_s;
  Vehicle vehicle = fit.vehicle;
  for (std::size_t u = 0; u < fit.drives.size(); ++u) vehicle = with_drive(vehicle, u, fit.drives[u]);
  const bool first = sigma.empty();
  double sum = 0.0;
  for (int u = 0; u < none.units; ++u) {
    const Passage passage(run, vehicle, none, 0, u);
    if (first) sigma.push_back(passage.deviations_at(x));
    sum += passage.squares_at(x, sigma[static_cast<std::size_t>(u)]);
  }
  return sum;
}

}  // namespace

MatrixXd moved_bodies(const MultiCastor& platform, const std::vector<std::string>& lengths) {
  MatrixXd moved = MatrixXd::Zero(4, static_cast<Eigen::Index>(lengths.size()));
  for (std::size_t k = 0; k < lengths.size(); ++k)
    for (std::size_t c = 0; c < platform.castors.size(); ++c) {
      const std::string key = "castor[" + std::to_string(c + 1) + "].";
      const double radius_m = platform.castors[c].pivot_radius_m;
      const Vec2 out = rotated({1.0, 0.0}, platform.castors[c].pivot_angle_rad);
      auto by = moved.col(static_cast<Eigen::Index>(k));
      if (lengths[k] == key + "pivot_radius_m") by << out.x_m, out.y_m, 0.0, 1.0;
      if (lengths[k] == key + "pivot_angle_rad") by << -radius_m * out.y_m, radius_m * out.x_m, radius_m, 0.0;
    }
  return moved;
}

GeometryFit fitted_geometry(const std::vector<JoinedRun>& runs, const Vehicle& nominal,
                            const std::vector<std::string>& held) {
  Unknowns unknowns;
  for (JointParameter& p : joint_parameters(nominal))
    if (std::find(held.begin(), held.end(), p.name) == held.end()) unknowns.joints.push_back(std::move(p));
  unknowns.wheels_are_held = std::find(held.begin(), held.end(), kWheelsHeld) != held.end();
  unknowns.units = static_cast<int>(units_of(nominal).size());
  unknowns.runs = static_cast<int>(runs.size());
  std::vector<Passage> passages;
  for (int r = 0; r < unknowns.runs; ++r)
    for (int u = 0; u < unknowns.units; ++u)
      passages.emplace_back(runs[static_cast<std::size_t>(r)], nominal, unknowns, r, u);

  const int n = unknowns.count();
  VectorXd x = VectorXd::Zero(n), prior(n);
  for (int k = 0; k < n; ++k) prior[k] = 1.0 / (unknowns.prior(k) * unknowns.prior(k));
  MatrixXd of_prior = prior.asDiagonal();
  hold_the_body(nominal, unknowns, of_prior);
  for (int iteration = 0; iteration < kGeometryIterations; ++iteration) {
    const GeometryNormal normal = sum_of_passages(passages, x, false);
    const VectorXd step = (normal.information + of_prior).ldlt().solve(normal.gradient - of_prior * x);
    x += step;
    if (step.cwiseAbs().maxCoeff() < 1e-6) break;
  }
  const GeometryNormal normal = sum_of_passages(passages, x, true);
  const MatrixXd inverse = (normal.information + of_prior).inverse();
  const MatrixXd covariance = inverse * (normal.spread + of_prior) * inverse;

  GeometryFit fit;
  fit.vehicle = nominal;
  fit.covariance = covariance.topLeftCorner(unknowns.joint_count(), unknowns.joint_count());
  for (int k = 0; k < unknowns.joint_count(); ++k) {
    JointEstimate e{unknowns.joints[static_cast<std::size_t>(k)]};
    Vehicle copy = nominal;
    e.nominal = e.parameter.of(copy);
    e.stderr_value = std::sqrt(covariance(k, k));
    e.determined = e.stderr_value < kDeterminedGeometryShare * e.parameter.prior;
    e.value = e.determined ? e.nominal + x[k] : e.nominal;
    if (e.determined) e.parameter.of(fit.vehicle) = e.value;
    fit.joints.push_back(std::move(e));
  }
  for (int u = 0; u < unknowns.units; ++u) {
    fit.drives.push_back(passages[static_cast<std::size_t>(u)].drive_at(x));
    const int aside = unknowns.aside(u);
    fit.aside_stderr_m.push_back(std::sqrt(covariance(aside, aside)));
    if (fit.aside_stderr_m.back() < kDeterminedGeometryShare * kAsidePrior_m)
      move_aside(fit.vehicle, static_cast<std::size_t>(u), x[aside]);
  }
  for (int r = 0; r < unknowns.runs; ++r) {
    fit.clock_s.push_back(x[unknowns.clock(r)]);
    fit.clock_stderr_s.push_back(std::sqrt(covariance(unknowns.clock(r), unknowns.clock(r))));
  }
  return fit;
}

void set_most_pivots_right(GeometryFit& fit) {
  std::vector<double> off;
  for (const JointEstimate& e : fit.joints)
    if (e.parameter.effect == "pivot_angle_bias" && e.determined) off.push_back(e.value - e.nominal);
  const auto* platform = std::get_if<MultiCastor>(&fit.vehicle.kind);
  if (!platform || off.size() < 3 || off.size() < platform->castors.size()) return;
  const double turn_rad = median(std::move(off));
  for (Castor& c : std::get<MultiCastor>(fit.vehicle.kind).castors) c.pivot_encoder_offset_rad -= turn_rad;
  turn_about_body(fit, turn_rad);
}

void turn_about_body(GeometryFit& fit, double turn_rad) {
  for (Castor& c : std::get<MultiCastor>(fit.vehicle.kind).castors) c.pivot_angle_rad += turn_rad;
  Pose& mounting = fit.vehicle.truth.axle_T_tracked;
  mounting = Pose{0.0, 0.0, turn_rad} * mounting;
  for (JointEstimate& e : fit.joints)
    if (e.determined) e.value = e.parameter.of(fit.vehicle);
}

double left_out_ratio(const std::vector<JoinedRun>& runs, const Vehicle& nominal, const std::string& joint,
                      const std::vector<std::string>& held) {
  if (runs.size() < 2) return 1.0;
  const GeometryFit all = fitted_geometry(runs, nominal, held);
  std::vector<std::string> held_without = held;
  held_without.push_back(joint);
  double with = 0.0, without = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::vector<JoinedRun> others = runs;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
    std::vector<Vector3d> sigma;
    with += squares_of_run(runs[r], fitted_geometry(others, nominal, held), all.clock_s[r], sigma);
    without += squares_of_run(runs[r], fitted_geometry(others, nominal, held_without), all.clock_s[r], sigma);
  }
  return without > 0.0 ? with / without : 1.0;
}

}  // namespace odolab
