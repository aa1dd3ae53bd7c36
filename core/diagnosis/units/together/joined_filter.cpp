#include "core/diagnosis/units/together/joined_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostRows = 3 * static_cast<int>(kMostJoinedUnits);
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
    : vehicle_(vehicle), samples_(run.samples), truth_rows_(run.has_headings ? 3 : 2) {
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
  MatrixXd turn = MatrixXd::Identity(rows(), rows());
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
    turn.block<2, 1>(k, 2) = swing(after, 0) - by * swing(before, 0);
  }
  return turn;
}

double JoinedFilter::run(const JoinedNoise& noise) {
  const Index n = rows();  // of the state, too: three numbers of each unit
  steps_.resize(readings());
  residual_ = VectorXd::Zero(n * static_cast<Index>(readings()));
  double minus_two_log = 0.0;

  const std::vector<double> joint_step = joint_steps(vehicle_);
  std::vector<double> count_m;
  for (const DifferentialDrive& d : drives_)
    count_m.push_back(2.0 * kPi * 0.5 * (d.wheel_radius_left_m + d.wheel_radius_right_m) / d.counts_per_wheel_turn());

  Small p(n, n);
  std::vector<Pose> at(units());
  const auto start = [&](const Pose& body, const Reading& reading, bool in_the_room) {
    for (std::size_t u = 0; u < units(); ++u) at[u] = body * inverse(reading.unit_T_body[u]);
    p.setZero();
    for (Index k = 0; k < n; k += 3) {
      if (k == 0 && !in_the_room) continue;  // where nothing says where the room is, the first unit begins it
      p(k, k) = p(k + 1, k + 1) = kUnknown_m * kUnknown_m;
      p(k + 2, k + 2) = kUnknown_rad * kUnknown_rad;
    }
  };
  if (std::any_of(readings_.begin(), readings_.end(), [](const Reading& r) { return !!r.truth; }))
    start(started_at(), readings_.front(), true);
  else
    start({}, readings_.front(), false);

  Small seen(n, n), err(n, n);
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
        const double square = noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m, base_m = drives_[u].wheelbase_m;
        Eigen::Matrix3d body = Eigen::Matrix3d::Zero();
        Eigen::Vector3d one;
        one << 0.5, -0.5 * moved.x_m / base_m, -1.0 / base_m;  // a turn on the way carries half of it aside
        body += square * left_m * one * one.transpose();
        one << 0.5, 0.5 * moved.x_m / base_m, 1.0 / base_m;
        body += square * right_m * one * one.transpose();
        body(1, 1) += noise.sideways_m_per_sqrt_m * noise.sideways_m_per_sqrt_m * 0.5 * (left_m + right_m);
        Eigen::Matrix3d to_room = Eigen::Matrix3d::Identity();
        to_room.topLeftCorner<2, 2>() = room;
        p.block<3, 3>(k, k) += to_room * body * to_room.transpose();
        at[u] = at[u] * moved;
      }
    }
    step.predicted = at;

    // What is read, and how it depends on the units' poses.
    const Pose first = at[0] * reading.unit_T_body[0];
    const VectorXd read = read_at(at, reading.unit_T_body, reading.truth);
    const Eigen::Matrix2d to_first = turned(-first.heading_rad);
    const Eigen::Matrix2d to_truth = turned(reading.truth ? -reading.truth->heading_rad : 0.0);
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
      put(3 * static_cast<Index>(u) - 3, to_first, 0, -1.0);
    }
    if (reading.truth) put(of_joints, to_truth, 0, 1.0);

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

    const auto squared = [&](Index from, Index count) {
      const Small h = seen.middleRows(from, count);
      Small s = h * p * h.transpose();
      s += err.block(from, from, count, count);
      return read.segment(from, count).dot(s.llt().solve(read.segment(from, count)));
    };
    if (reading.joints_are_read && r > 0 && are_torn_apart(read, of_joints)) {
      const Eigen::Matrix3d of_first = p.topLeftCorner<3, 3>();  // what joins the units has jumped: they are put anew
      start(first, reading, true);
      p.topLeftCorner<3, 3>() = of_first;
      step.starts = true;
      step.predicted = step.corrected = at;
      continue;
    }
    // Either the joints, or the truth, or both: a block of rows.
    const Index from = reading.joints_are_read ? 0 : of_joints;
    const bool with_truth = reading.truth && (r == 0 || squared(of_joints, truth_rows_) < kGateOfTruth);
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
    by = gain * -read.segment(from, m);
    p -= gain * ph.transpose();
    // Where units stand against the first is linear in what they are off by; where they stand in the room is not, once
    // the first turns.
    const VectorXd apart = read.head(of_joints) + seen.topRows(of_joints) * by;
    at[0] = {at[0].x_m + by[0], at[0].y_m + by[1], at[0].heading_rad + by[2]};
    const Pose body = at[0] * reading.unit_T_body[0];
    for (std::size_t u = 1; u < units(); ++u) {
      const Index k = 3 * static_cast<Index>(u);
      const double about_rad = at[u].heading_rad + by[k + 2];
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

Pose JoinedFilter::started_at() const {
  const auto by_wheels = [&](const Reading& r) { return on_the_way(way_[0], r.time_s) * r.unit_T_body[0]; };
  const Pose first = by_wheels(readings_.front());
  if (truth_rows_ == 3) {
    const auto seen = std::find_if(readings_.begin(), readings_.end(), [](const Reading& r) { return !!r.truth; });
    return *seen->truth * between(by_wheels(*seen), first);
  }
  // Positions alone: as the first unit's way lies best upon them, while it is too short to have gone astray.
  constexpr double kFew_m = 3.0;
  std::vector<Vec2> way, truth;
  Vec2 mean_way{}, mean_truth{};
  double gone_m = 0.0;
  for (std::size_t r = 0; r < readings_.size() && (gone_m < kFew_m || way.size() < 2); ++r) {
    if (r > 0) gone_m += 0.5 * (rolled_m_[0][r - 1][0] + rolled_m_[0][r - 1][1]);
    if (!readings_[r].truth) continue;
    way.push_back(by_wheels(readings_[r]).position());
    truth.push_back(readings_[r].truth->position());
    mean_way = mean_way + way.back();
    mean_truth = mean_truth + truth.back();
  }
  mean_way = 1.0 / static_cast<double>(way.size()) * mean_way;
  mean_truth = 1.0 / static_cast<double>(way.size()) * mean_truth;
  double cosine = 0.0, sine = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    cosine += dot(way[i] - mean_way, truth[i] - mean_truth);
    sine += cross(way[i] - mean_way, truth[i] - mean_truth);
  }
  const double turn_rad = std::atan2(sine, cosine);
  const Vec2 at = mean_truth + rotated(first.position() - mean_way, turn_rad);
  return {at.x_m, at.y_m, first.heading_rad + turn_rad};
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
  MatrixXd off = MatrixXd::Zero(n, count), passed(n, count);
  const bool acts = std::any_of(columns.begin(), columns.end(), [](const JoinedColumn& c) {
    return c.read.cols() > 0 || std::any_of(c.moved.begin(), c.moved.end(), [](const auto& m) { return m.cols() > 0; });
  });
  if (!acts) return out;
  for (std::size_t r = 0; r < readings(); ++r) {
    const Step& step = steps_[r];
    if (step.starts && r > 0) {
      // The units are put anew where the first one and the joints say: what the first is off by, all are.
      for (Index c = 0; c < count; ++c)
        for (std::size_t u = 1; u < units(); ++u) off.col(c).segment<3>(3 * static_cast<Index>(u)).setZero();
      continue;
    }
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

std::vector<JoinedFilter::Impact> JoinedFilter::impacts(const VectorXd& left) const {
  const Index n = rows();
  std::vector<Impact> all(readings() - 1);
  VectorXd score = VectorXd::Zero(n);
  MatrixXd information = MatrixXd::Zero(n, n);
  for (std::size_t r = readings() - 1; r > 0; --r) {
    const Step& step = steps_[r];
    if (step.starts) {  // what went before is known by the first unit alone
      score.tail(n - 3).setZero();
      information.rightCols(n - 3).setZero();
      information.bottomRows(n - 3).setZero();
    } else if (step.count > 0) {
      score = step.out.transpose() * left.segment(static_cast<Index>(r) * n + step.first_row, step.count) +
              step.on.transpose() * score;
      information = step.out.transpose() * step.out + step.on.transpose() * information * step.on;
    }
    Impact& here = all[r - 1];
    here.time_s = 0.5 * (readings_[r - 1].time_s + readings_[r].time_s);
    here.units = step.predicted;
    here.score = score;
    here.information = information;
    for (std::size_t u = 0; u < units(); ++u) {  // back over the way: a heading before swings what follows
      const auto k = 3 * static_cast<Index>(u);
      const Vec2 ahead = step.predicted[u].position() - steps_[r - 1].corrected[u].position();
      score[k + 2] += -ahead.y_m * score[k] + ahead.x_m * score[k + 1];
      information.col(k + 2) += -ahead.y_m * information.col(k) + ahead.x_m * information.col(k + 1);
    }
    for (std::size_t u = 0; u < units(); ++u) {
      const auto k = 3 * static_cast<Index>(u);
      const Vec2 ahead = step.predicted[u].position() - steps_[r - 1].corrected[u].position();
      information.row(k + 2) += -ahead.y_m * information.row(k) + ahead.x_m * information.row(k + 1);
    }
  }
  return all;
}

}  // namespace odolab
