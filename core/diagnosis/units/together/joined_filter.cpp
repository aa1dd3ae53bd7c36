#include "core/diagnosis/units/together/joined_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/unit_recordings.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostRows = 3 * static_cast<int>(kMostJoinedUnits) + 3;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;

constexpr double kEpoch_s = 0.075;  // and more, from one reading of the joints to the next that is looked at
constexpr double kUnknown_m = 0.5, kUnknown_rad = 0.3;  // where the filter starts
constexpr double kGateOfTruth = 25.0;                   // squared, of its three numbers

Eigen::Matrix2d turned(double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  Eigen::Matrix2d r;
  r << c, -s, s, c;
  return r;
}

// No wheel errs by so much between two readings: an encoder lost its place.
bool are_torn_apart(const VectorXd& read, Index of_joints) {
  constexpr double kMost_m = 0.1, kMost_rad = 0.3;
  for (Index k = 0; k < of_joints; k += 3)
    if (std::hypot(read[k], read[k + 1]) > kMost_m || std::abs(read[k + 2]) > kMost_rad) return true;
  return false;
}

}  // namespace

JoinedFilter::JoinedFilter(const JoinedRun& run, const Vehicle& vehicle, double clock_s)
    : vehicle_(vehicle),
      samples_(run.samples),
      truth_rows_(run.has_headings ? 3 : 2),
      outliers_show_(comes_often(run.tracked)) {
  for (std::size_t u = 0; u < samples_.front().wheels.size(); ++u) {
    drives_.push_back(units_of(vehicle_)[u].drive);
    way_.push_back(dead_reckoned(wheels_of(samples_, u), drives_.back(), Pose{}, HeadingRule::arc));
  }
  const double late_s = vehicle_.truth.time_offset_s + clock_s;
  std::size_t t = 0;
  while (t < run.tracked.size() && run.tracked[t].time_s - late_s < samples_.front().time_s) ++t;
  double last_s = -1e300;
  for (const UnitSample& s : samples_) {
    for (; t < run.tracked.size() && run.tracked[t].time_s - late_s <= s.time_s; ++t) {
      const double at_s = run.tracked[t].time_s - late_s;
      readings_.push_back({at_s, joints_at(samples_, at_s), run.tracked[t].pose, false, {}, {}});
    }
    if (s.time_s < last_s + kEpoch_s) continue;
    last_s = s.time_s;
    if (!readings_.empty() && readings_.back().time_s == s.time_s)
      readings_.back().joints_are_read = true;
    else
      readings_.push_back({s.time_s, s.joints, std::nullopt, true, {}, {}});
  }
  for (Reading& reading : readings_) {
    reading.unit_T_body = units_T_body(vehicle_, reading.joints);
    for (std::size_t j = 0; j < reading.joints.size() && reading.joints_are_read; ++j) {
      constexpr double kStep = 1e-6;
      std::vector<double> more = reading.joints;
      more[j] += kStep;
      std::vector<Pose> by = units_T_body(vehicle_, more);
      for (std::size_t u = 0; u < units(); ++u) {
        const Pose& now = reading.unit_T_body[u];
        by[u] = {(by[u].x_m - now.x_m) / kStep, (by[u].y_m - now.y_m) / kStep,
                 (by[u].heading_rad - now.heading_rad) / kStep};
      }
      reading.by_joint.push_back(std::move(by));
    }
  }
  moved_.resize(units());
  rolled_m_.resize(units());
  for (std::size_t u = 0; u < units(); ++u) {
    std::vector<std::array<double, 2>> gone{{0.0, 0.0}};  // at each sample
    for (std::size_t i = 1; i < samples_.size(); ++i)
      gone.push_back(
          {gone.back()[0] + drives_[u].wheel_radius_left_m *
                                std::abs(samples_[i].wheels[u].left_rad - samples_[i - 1].wheels[u].left_rad),
           gone.back()[1] + drives_[u].wheel_radius_right_m *
                                std::abs(samples_[i].wheels[u].right_rad - samples_[i - 1].wheels[u].right_rad)});
    const auto gone_at = [&](double time_s) {
      const auto after = std::lower_bound(samples_.begin() + 1, samples_.end() - 1, time_s,
                                          [](const UnitSample& s, double at) { return s.time_s < at; });
      const auto k = static_cast<std::size_t>(after - samples_.begin());
      const double share = std::clamp(
          (time_s - samples_[k - 1].time_s) / std::max(samples_[k].time_s - samples_[k - 1].time_s, 1e-9), 0.0, 1.0);
      return std::array<double, 2>{gone[k - 1][0] + share * (gone[k][0] - gone[k - 1][0]),
                                   gone[k - 1][1] + share * (gone[k][1] - gone[k - 1][1])};
    };
    for (std::size_t e = 0; e + 1 < readings_.size(); ++e) {
      const double from_s = readings_[e].time_s, to_s = readings_[e + 1].time_s;
      moved_[u].push_back(between(on_the_way(way_[u], from_s), on_the_way(way_[u], to_s)));
      const auto a = gone_at(from_s), b = gone_at(to_s);
      rolled_m_[u].push_back({b[0] - a[0], b[1] - a[1]});
    }
  }
  is_guessed_.assign(units(), std::vector<char>(readings_.size() - 1, 0));
  for (std::size_t u = 0; u < run.guessed.size(); ++u)
    for (const auto& [from_s, to_s] : run.guessed[u])
      for (std::size_t e = 0; e + 1 < readings_.size(); ++e)
        if (readings_[e].time_s < to_s && readings_[e + 1].time_s > from_s) is_guessed_[u][e] = 1;
  cut_into_pieces();
}

std::vector<Pose> JoinedFilter::units_T_body(const Vehicle& vehicle, const std::vector<double>& joints) const {
  std::vector<Pose> all;
  for (std::size_t u = 0; u < units(); ++u) all.push_back(inverse(tracked_T_axle(vehicle, u, joints)));
  return all;
}

VectorXd JoinedFilter::read_at(const std::vector<Pose>& units, const std::vector<Pose>& unit_T_body,
                               const std::optional<Pose>& truth) const {
  VectorXd all = VectorXd::Zero(rows());
  const Pose first = units[0] * unit_T_body[0];
  for (std::size_t u = 1; u < units.size(); ++u) {
    const Pose off = between(first, units[u] * unit_T_body[u]);
    all.segment<3>(3 * static_cast<Index>(u) - 3) << off.x_m, off.y_m, wrapped(off.heading_rad);
  }
  if (truth) {  // seen from the truth
    const Pose off = between(*truth, first);
    all.tail<3>() << off.x_m, off.y_m, wrapped(off.heading_rad);
  }
  return all;
}

void JoinedFilter::put_in(const JoinedColumn& column, double value) {
  for (std::size_t u = 0; u < column.moved.size(); ++u)
    for (Index e = 0; e < column.moved[u].cols(); ++e) {
      Pose& moved = moved_[u][static_cast<std::size_t>(e)];
      moved.x_m += value * column.moved[u](0, e);
      moved.y_m += value * column.moved[u](1, e);
      moved.heading_rad += value * column.moved[u](2, e);
    }
}

// What the units are off by is known against the first one, as it stands: corrected poses turn that with them, or
// joints that are read again and again would seem to tell where the room is (G. P. Huang, A. I. Mourikis and S. I.
// Roumeliotis, "Observability-based rules for designing consistent EKF SLAM estimators", International Journal of
// Robotics Research 29(5):502-528, 2010).
MatrixXd JoinedFilter::turned_with(const std::vector<Pose>& before, const std::vector<Pose>& after,
                                   const std::vector<Pose>& unit_T_body) const {
  MatrixXd turn = MatrixXd::Identity(states(), states());
  const auto swing = [&](const std::vector<Pose>& poses, std::size_t u) {  // of the body, by the unit's heading
    const Vec2 arm = rotated(unit_T_body[u].position(), poses[u].heading_rad);
    return Eigen::Vector2d(-arm.y_m, arm.x_m);
  };
  const Eigen::Matrix2d by = turned(after[0].heading_rad - before[0].heading_rad);
  for (std::size_t u = 1; u < units(); ++u) {
    const auto k = 3 * static_cast<Index>(u);
    turn.block<2, 2>(k, k) = by;
    turn.block<2, 1>(k, k + 2) = by * swing(before, u) - swing(after, u);
    turn.block<2, 2>(k, 0) = Eigen::Matrix2d::Identity() - by;
    // How far it stands from the first turns with that.
    const auto apart = [&](const std::vector<Pose>& poses) {
      const Vec2 to = (poses[u] * unit_T_body[u]).position() - (poses[0] * unit_T_body[0]).position();
      return Eigen::Vector2d(-to.y_m, to.x_m);
    };
    turn.block<2, 1>(k, 2) = swing(after, 0) - by * swing(before, 0) + apart(after) - by * apart(before);
  }
  return turn;
}

double JoinedFilter::run(const JoinedNoise& noise) {
  wanders_ = noise.wander_m_per_sqrt_s > 0.0 || noise.wander_rad_per_sqrt_s > 0.0;
  wander_lasts_s_ = noise.wander_lasts_s;
  const Index n = rows(), count_of_states = states(), of_frame = n;
  steps_.resize(readings());
  residual_ = VectorXd::Zero(n * static_cast<Index>(readings()));
  double minus_two_log = 0.0;

  const std::vector<double> joint_step = joint_steps(vehicle_);
  std::vector<double> count_m;
  for (const DifferentialDrive& d : drives_)
    count_m.push_back(2.0 * kPi * 0.5 * (d.wheel_radius_left_m + d.wheel_radius_right_m) / d.counts_per_wheel_turn());

  Small p = Small::Zero(count_of_states, count_of_states);
  Pose wandered;    // the truth's frame
  int refused = 0;  // samples of the truth in a row
  const double wander2[] = {std::pow(noise.wander_m_per_sqrt_s, 2), std::pow(noise.wander_m_per_sqrt_s, 2),
                            std::pow(noise.wander_rad_per_sqrt_s, 2)};
  std::vector<Pose> at(units());
  const auto start = [&](const Pose& body, const Reading& reading, bool in_room) {
    for (std::size_t u = 0; u < units(); ++u) at[u] = body * inverse(reading.unit_T_body[u]);
    p.setZero();
    for (Index k = 0; k < n; k += 3) {
      if (k == 0 && !in_room) continue;  // where nothing says where the room is, the first unit begins it
      p(k, k) = p(k + 1, k + 1) = kUnknown_m * kUnknown_m;
      p(k + 2, k + 2) = kUnknown_rad * kUnknown_rad;
    }
  };
  const bool in_the_room = std::any_of(readings_.begin(), readings_.end(), [](const Reading& r) { return !!r.truth; });
  start(in_the_room ? started_at() : Pose{}, readings_.front(), in_the_room);
  for (Index k = 0; k < 3 && wanders_ && wander_lasts_s_ > 0.0; ++k)
    p(of_frame + k, of_frame + k) = 0.5 * wander2[k] * wander_lasts_s_;

  Small seen(n, count_of_states), err(n, n);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1> by(n);
  for (std::size_t r = 0; r < readings(); ++r) {
    Step& step = steps_[r];
    const Reading& reading = readings_[r];
    step.starts = r == 0;
    step.count = 0;
    if (r > 0) {
      for (std::size_t u = 0; u < units(); ++u) {
        const auto k = 3 * static_cast<Index>(u);
        const Pose& moved = moved_[u][r - 1];
        const Eigen::Vector2d ahead = turned(at[u].heading_rad) * Eigen::Vector2d(moved.x_m, moved.y_m);
        p.row(k) -= ahead[1] * p.row(k + 2);
        p.row(k + 1) += ahead[0] * p.row(k + 2);
      }
      for (std::size_t u = 0; u < units(); ++u) {
        const auto k = 3 * static_cast<Index>(u);
        const Pose& moved = moved_[u][r - 1];
        const Eigen::Matrix2d room = turned(at[u].heading_rad);
        const Eigen::Vector2d ahead = room * Eigen::Vector2d(moved.x_m, moved.y_m);
        p.col(k) -= ahead[1] * p.col(k + 2);
        p.col(k + 1) += ahead[0] * p.col(k + 2);
        const auto [left_m, right_m] = rolled_m_[u][r - 1];
        const double base_m = drives_[u].wheelbase_m;
        const auto variance_m2 = [&, u](double rolled_m) {
          constexpr double kGuess = 2.0, kGuess_m = 0.002;  // of what was guessed, and more
          const double guess_m = is_guessed_[u][r - 1] ? kGuess * rolled_m + kGuess_m : 0.0;
          return noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m * rolled_m + guess_m * guess_m;
        };
        Eigen::Matrix3d body = Eigen::Matrix3d::Zero();
        Eigen::Vector3d one;
        one << 0.5, -0.5 * moved.x_m / base_m, -1.0 / base_m;  // a turn on the way carries half of it aside
        body += variance_m2(left_m) * one * one.transpose();
        one << 0.5, 0.5 * moved.x_m / base_m, 1.0 / base_m;
        body += variance_m2(right_m) * one * one.transpose();
        body(1, 1) += noise.sideways_m_per_sqrt_m * noise.sideways_m_per_sqrt_m * 0.5 * (left_m + right_m);
        Eigen::Matrix3d to_room = Eigen::Matrix3d::Identity();
        to_room.topLeftCorner<2, 2>() = room;
        p.block<3, 3>(k, k) += to_room * body * to_room.transpose();
        at[u] = at[u] * moved;
      }
      if (wanders_) {
        const double kept = kept_of_frame(r), lasts_s = reading.time_s - readings_[r - 1].time_s;
        p.bottomRows(3) *= kept;
        p.rightCols(3) *= kept;
        wandered = {kept * wandered.x_m, kept * wandered.y_m, kept * wandered.heading_rad};
        for (Index k = 0; k < 3; ++k)
          p(of_frame + k, of_frame + k) +=
              wander2[k] * (wander_lasts_s_ > 0.0 ? 0.5 * wander_lasts_s_ * (1.0 - kept * kept) : lasts_s);
      }
    }
    step.predicted = at;
    step.uncertain = p;

    // What is read, and how it depends on the units' poses.
    const Pose first = at[0] * reading.unit_T_body[0];
    std::optional<Pose> truth = reading.truth;
    if (truth)
      truth = Pose{truth->x_m - wandered.x_m, truth->y_m - wandered.y_m, truth->heading_rad - wandered.heading_rad};
    const VectorXd read = read_at(at, reading.unit_T_body, truth);
    const Eigen::Matrix2d to_first = turned(-first.heading_rad);
    const Eigen::Matrix2d to_truth = turned(truth ? -truth->heading_rad : 0.0);
    const Index of_joints = n - 3;
    seen.setZero();
    const auto put = [&](Index row, const Eigen::Matrix2d& frame, std::size_t u, double sign) {
      const auto k = 3 * static_cast<Index>(u);
      const Vec2 arm = rotated(reading.unit_T_body[u].position(), at[u].heading_rad);
      seen.block<2, 2>(row, k) = sign * frame;
      seen.block<2, 1>(row, k + 2) = sign * (frame * Eigen::Vector2d(-arm.y_m, arm.x_m));
      seen(row + 2, k + 2) = sign;
    };
    for (std::size_t u = 1; u < units(); ++u) {
      put(3 * static_cast<Index>(u) - 3, to_first, u, 1.0);
      const Index row = 3 * static_cast<Index>(u) - 3;
      put(row, to_first, 0, -1.0);
      seen(row, 2) += read[row + 1];  // it is seen by the first, which turns
      seen(row + 1, 2) -= read[row];
    }
    if (reading.truth) put(of_joints, to_truth, 0, 1.0);
    if (reading.truth && wanders_) {
      seen.block<2, 2>(of_joints, of_frame) = to_truth;
      seen(of_joints + 2, of_frame + 2) = 1.0;
    }

    err.setZero();
    for (std::size_t j = 0; j < reading.by_joint.size(); ++j) {
      by.setZero();
      const auto moved_by = [&](std::size_t u) {
        const Pose& here = reading.by_joint[j][u];
        const Vec2 room = rotated(here.position(), at[u].heading_rad);
        return Eigen::Vector3d(room.x_m, room.y_m, here.heading_rad);
      };
      const auto in = [](const Eigen::Matrix2d& frame, const Eigen::Vector3d& moved) {
        Eigen::Vector3d out;
        out << frame * moved.head<2>(), moved[2];
        return out;
      };
      const Eigen::Vector3d of_first = moved_by(0);
      for (std::size_t u = 1; u < units(); ++u)
        by.segment<3>(3 * static_cast<Index>(u) - 3) = in(to_first, moved_by(u) - of_first);
      if (reading.truth) by.tail<3>() = in(to_truth, of_first);
      err += std::pow(noise.joint_steps * joint_step[j], 2) * by * by.transpose();
    }
    for (std::size_t u = 0; u < units(); ++u) {  // a count that is not full yet
      const double variance = count_m[u] * count_m[u] / 12.0, base_m = drives_[u].wheelbase_m;
      const auto k = 3 * static_cast<Index>(u);
      for (const double side : {-1.0, 1.0}) {
        by = seen.middleCols(k, 3) *
             Eigen::Vector3d(0.5 * std::cos(at[u].heading_rad), 0.5 * std::sin(at[u].heading_rad), side / base_m);
        err += variance * by * by.transpose();
      }
    }
    for (Index k = 0; k < of_joints; ++k) {
      const double apart = k % 3 == 2 ? noise.apart_m / drives_[0].wheelbase_m : noise.apart_m;
      err(k, k) += apart * apart;
    }
    err(of_joints, of_joints) += noise.truth_position_m * noise.truth_position_m;
    err(of_joints + 1, of_joints + 1) += noise.truth_position_m * noise.truth_position_m;
    err(of_joints + 2, of_joints + 2) += noise.truth_heading_rad * noise.truth_heading_rad;

    // Whether the truth is none of its outliers, which cost what the last does that is none: samples that are left out
    // for nothing would make any noise likely that leaves out many.
    const auto is_taken = [&] {
      if (!outliers_show_) return true;
      const Small h = seen.middleRows(of_joints, truth_rows_);
      Small s = h * p * h.transpose();
      s += err.block(of_joints, of_joints, truth_rows_, truth_rows_);
      const Eigen::LLT<Small> root(s);
      const VectorXd off = read.segment(of_joints, truth_rows_);
      if (off.dot(root.solve(off)) < kGateOfTruth) return true;
      minus_two_log += kGateOfTruth;
      for (Index k = 0; k < truth_rows_; ++k) minus_two_log += 2.0 * std::log(root.matrixLLT()(k, k));
      return false;
    };
    // A truth that is contradicted all the time is right, and the poses are lost.
    const auto is_lost = [&] {
      constexpr int kMostInARow = 8;
      if (++refused < kMostInARow) return false;
      Small rigid = Small::Zero(count_of_states, 3);
      for (std::size_t u = 0; u < units(); ++u) {
        const Index k = 3 * static_cast<Index>(u);
        rigid.block<3, 3>(k, 0).setIdentity();
        rigid(k, 2) = -(at[u].y_m - at[0].y_m);
        rigid(k + 1, 2) = at[u].x_m - at[0].x_m;
      }
      const Eigen::Vector3d unknown2(kUnknown_m * kUnknown_m, kUnknown_m * kUnknown_m, kUnknown_rad * kUnknown_rad);
      p += rigid * unknown2.asDiagonal() * rigid.transpose();
      return true;
    };
    if (reading.joints_are_read && r > 0 && are_torn_apart(read, of_joints)) {
      const Small before = p;  // what joins the units has jumped: they are put anew
      start(first, reading, true);
      p.topLeftCorner<3, 3>() = before.topLeftCorner<3, 3>();
      if (wanders_) {
        p.topRightCorner<3, 3>() = before.topRightCorner<3, 3>();
        p.bottomLeftCorner<3, 3>() = before.bottomLeftCorner<3, 3>();
        p.bottomRightCorner<3, 3>() = before.bottomRightCorner<3, 3>();
      }
      step.starts = true;
      step.predicted = step.corrected = at;
      continue;
    }
    // Either the joints, or the truth, or both: a block of rows.
    const Index from = reading.joints_are_read ? 0 : of_joints;
    const bool with_truth = reading.truth && (is_taken() || is_lost());
    if (with_truth) refused = 0;
    const Index m = of_joints + (with_truth ? truth_rows_ : 0) - from;
    if (m <= 0) {
      step.corrected = at;
      continue;
    }
    const Small h = seen.middleRows(from, m);
    const Small ph = p * h.transpose();
    Small s = h * ph;
    s += err.block(from, from, m, m);
    const Eigen::LLT<Small> root(s);
    const VectorXd white = root.matrixL().solve(-read.segment(from, m));
    step.whitener = root.matrixL().solve(Small::Identity(m, m));
    const Small gain = root.solve(ph.transpose()).transpose();
    step.out = step.whitener * h;
    step.first_row = from;
    step.count = m;
    for (Index a = 0; a < m; ++a) {
      residual_[static_cast<Index>(r) * n + from + a] = white[a];
      minus_two_log += white[a] * white[a] + 2.0 * std::log(root.matrixLLT()(a, a));
    }
    const VectorXd off = gain * -read.segment(from, m);
    if (wanders_)
      wandered = {wandered.x_m + off[of_frame], wandered.y_m + off[of_frame + 1],
                  wandered.heading_rad + off[of_frame + 2]};
    p -= gain * ph.transpose();
    // Where units stand against the first is linear in what they are off by; where they stand in the room is not, once
    // the first turns.
    const VectorXd apart = read.head(of_joints) + seen.topRows(of_joints) * off;
    at[0] = {at[0].x_m + off[0], at[0].y_m + off[1], at[0].heading_rad + off[2]};
    const Pose body = at[0] * reading.unit_T_body[0];
    for (std::size_t u = 1; u < units(); ++u) {
      const Index k = 3 * static_cast<Index>(u);
      const double about_rad = at[u].heading_rad + off[k + 2];
      at[u] = body * Pose{apart[k - 3], apart[k - 2], apart[k - 1]} * inverse(reading.unit_T_body[u]);
      at[u].heading_rad = unwrapped(at[u].heading_rad, about_rad);
    }
    step.corrected = at;
    const Small turn = turned_with(step.predicted, at, reading.unit_T_body);
    p = turn * p * turn.transpose();
    p = 0.5 * (p + p.transpose()).eval();
    step.gain = turn * gain;
    step.on = turn - step.gain * h;
  }
  return minus_two_log;
}

double JoinedFilter::kept_of_frame(std::size_t reading) const {
  return wander_lasts_s_ > 0.0
             ? std::exp(-(readings_[reading].time_s - readings_[reading - 1].time_s) / wander_lasts_s_)
             : 1.0;
}

Pose JoinedFilter::on_the_way(const Track& track, double time_s) {
  return *pose_at(track, std::clamp(time_s, track.front().time_s, track.back().time_s));
}

Track JoinedFilter::track(std::size_t unit) const {
  Track track;
  for (std::size_t r = 0; r < readings(); ++r) track.push_back({readings_[r].time_s, steps_[r].corrected[unit]});
  return track;
}

MatrixXd JoinedFilter::carried(const std::vector<JoinedColumn>& columns) const {
  const Index n = rows(), count = static_cast<Index>(columns.size());
  MatrixXd out = MatrixXd::Zero(n * static_cast<Index>(readings()), count);
  MatrixXd off = MatrixXd::Zero(states(), count), passed(states(), count);
  const bool acts = std::any_of(columns.begin(), columns.end(), [](const JoinedColumn& c) {
    return c.read.cols() > 0 || std::any_of(c.moved.begin(), c.moved.end(), [](const auto& m) { return m.cols() > 0; });
  });
  if (!acts) return out;
  const auto acts_at = [&](std::size_t r) {
    return std::any_of(columns.begin(), columns.end(), [&](const JoinedColumn& c) {
      const auto k = static_cast<Index>(r);
      return (c.read.cols() > 0 && (c.read.col(k).array() != 0.0).any()) ||
             (r > 0 && std::any_of(c.moved.begin(), c.moved.end(),
                                   [&](const auto& m) { return m.cols() > 0 && (m.col(k - 1).array() != 0.0).any(); }));
    });
  };
  bool has_acted = false;
  for (std::size_t r = 0; r < readings(); ++r) {
    has_acted = has_acted || acts_at(r);
    if (!has_acted) continue;
    const Step& step = steps_[r];
    if (step.starts && r > 0) {
      // The units are put anew where the first one and the joints say: what the first is off by, all are.
      for (Index c = 0; c < count; ++c)
        for (std::size_t u = 1; u < units(); ++u) off.col(c).segment<3>(3 * static_cast<Index>(u)).setZero();
      continue;
    }
    if (r > 0 && wanders_) off.bottomRows(3) *= kept_of_frame(r);
    if (r > 0)
      for (std::size_t u = 0; u < units(); ++u) {
        const auto k = 3 * static_cast<Index>(u);
        const Pose& before = steps_[r - 1].corrected[u];
        const Vec2 ahead = step.predicted[u].position() - before.position();
        off.row(k) -= ahead.y_m * off.row(k + 2);
        off.row(k + 1) += ahead.x_m * off.row(k + 2);
        const Eigen::Matrix2d room = turned(before.heading_rad);
        for (Index c = 0; c < count; ++c) {
          const JoinedColumn& column = columns[static_cast<std::size_t>(c)];
          if (column.moved.empty() || column.moved[u].cols() == 0) continue;
          const Eigen::Vector3d m = column.moved[u].col(static_cast<Index>(r) - 1);
          off.block<2, 1>(k, c) += room * m.head<2>();
          off(k + 2, c) += m[2];
        }
      }
    if (step.count == 0) continue;
    auto here = out.middleRows(static_cast<Index>(r) * n + step.first_row, step.count);
    here.noalias() = step.out * off;
    passed.noalias() = step.on * off;
    for (Index c = 0; c < count; ++c) {
      const JoinedColumn& column = columns[static_cast<std::size_t>(c)];
      if (column.read.cols() == 0) continue;
      const auto by = column.read.col(static_cast<Index>(r)).segment(step.first_row, step.count);
      here.col(c).noalias() += step.whitener * by;
      passed.col(c).noalias() -= step.gain * by;
    }
    off.swap(passed);
  }
  return out;
}

}  // namespace odolab
