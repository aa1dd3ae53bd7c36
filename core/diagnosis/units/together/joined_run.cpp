// How the filter goes through a recording, once.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/together/joined_filter.h"

namespace odolab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

// Where the filter stands.
struct JoinedFilter::State {
  std::vector<Pose> at;                   // of each unit
  Small p;                                // covariance of what they, and behind them the truth's frame, are off by
  Pose wandered;                          // the truth's frame
  std::vector<std::size_t> refused = {};  // samples of the truth in a row
};

// What is read, how it depends on the states, and how it errs.
struct JoinedFilter::Seen {
  VectorXd read;
  Small by_states, err;
};

void JoinedFilter::put_units(State& state, const Pose& body, const Reading& reading, bool in_room) const {
  for (std::size_t u = 0; u < units(); ++u) state.at[u] = body * inverse(reading.unit_T_body[u]);
  state.p.setZero();
  for (Index k = 0; k < rows(); k += 3) {
    if (k == 0 && !in_room) continue;  // where nothing says where the room is, the first unit begins it
    state.p(k, k) = state.p(k + 1, k + 1) = kUnknown_m * kUnknown_m;
    state.p(k + 2, k + 2) = kUnknown_rad * kUnknown_rad;
  }
}

JoinedFilter::State JoinedFilter::begun(const JoinedNoise& noise) const {
  State state{std::vector<Pose>(units()), Small::Zero(states(), states()), {}};
  const bool in_the_room = std::any_of(readings_.begin(), readings_.end(), [](const Reading& r) { return !!r.truth; });
  put_units(state, in_the_room ? started_at() : Pose{}, readings_.front(), in_the_room);
  if (wanders_ && wander_lasts_s_ > 0.0) {
    const double place2 = 0.5 * std::pow(noise.wander_m_per_sqrt_s, 2) * wander_lasts_s_,
                 heading2 = 0.5 * std::pow(noise.wander_rad_per_sqrt_s, 2) * wander_lasts_s_;
    state.p.diagonal().tail<3>() << place2, place2, heading2;
  }
  return state;
}

void JoinedFilter::go_on(std::size_t reading, const JoinedNoise& noise, State& state) const {
  std::vector<Pose>& at = state.at;
  Small& p = state.p;
  std::array<Eigen::Matrix2d, kMostJoinedUnits> room_R_unit;
  std::array<Eigen::Vector2d, kMostJoinedUnits> aheads;
  for (std::size_t u = 0; u < units(); ++u) {
    const auto k = 3 * static_cast<Index>(u);
    const Pose& moved = moved_[u][reading - 1];
    room_R_unit[u] = turned(at[u].heading_rad);
    const Eigen::Vector2d& ahead = aheads[u] = room_R_unit[u] * Eigen::Vector2d(moved.x_m, moved.y_m);
    p.row(k) -= ahead[1] * p.row(k + 2);
    p.row(k + 1) += ahead[0] * p.row(k + 2);
  }
  for (std::size_t u = 0; u < units(); ++u) {
    const auto k = 3 * static_cast<Index>(u);
    const Pose& moved = moved_[u][reading - 1];
    const Eigen::Matrix2d& room = room_R_unit[u];
    const Eigen::Vector2d& ahead = aheads[u];
    p.col(k) -= ahead[1] * p.col(k + 2);
    p.col(k + 1) += ahead[0] * p.col(k + 2);
    const auto [left_m, right_m] = rolled_m_[u][reading - 1];
    const double base_m = drives_[u].wheelbase_m;
    const auto variance_m2 = [&, u](double rolled_m) {
      constexpr double kGuess = 2.0, kGuess_m = 0.002;  // of what was guessed, and more
      const double guess_m = is_guessed_[u][reading - 1] ? kGuess * rolled_m + kGuess_m : 0.0;
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
  if (!wanders_) return;
  const double kept = kept_of_frame(reading), lasts_s = readings_[reading].time_s - readings_[reading - 1].time_s,
               for_s = wander_lasts_s_ > 0.0 ? 0.5 * wander_lasts_s_ * (1.0 - kept * kept) : lasts_s;
  p.bottomRows(3) *= kept;
  p.rightCols(3) *= kept;
  state.wandered = {kept * state.wandered.x_m, kept * state.wandered.y_m, kept * state.wandered.heading_rad};
  for (Index k = 0; k < 3; ++k) {
    const double rate = k < 2 ? noise.wander_m_per_sqrt_s : noise.wander_rad_per_sqrt_s;
    p(rows() + k, rows() + k) += std::pow(rate, 2) * for_s;
  }
}

void JoinedFilter::look(const Reading& reading, const JoinedNoise& noise, const State& state, Seen& seen) const {
  const std::vector<Pose>& at = state.at;
  const Index of_joints = rows() - 3, of_frame = rows();
  const Pose first = at[0] * reading.unit_T_body[0];
  std::optional<Pose> truth = reading.truth;
  if (truth)
    truth = Pose{truth->x_m - state.wandered.x_m, truth->y_m - state.wandered.y_m,
                 truth->heading_rad - state.wandered.heading_rad};
  seen.read = read_at(at, reading.unit_T_body, truth);
  const Eigen::Matrix2d to_first = turned(-first.heading_rad);
  const Eigen::Matrix2d to_truth = turned(truth ? -truth->heading_rad : 0.0);
  Small& h = seen.by_states;
  h.setZero();
  const auto put = [&](Index row, const Eigen::Matrix2d& frame, std::size_t u, double sign) {
    const auto k = 3 * static_cast<Index>(u);
    const Vec2 arm = rotated(reading.unit_T_body[u].position(), at[u].heading_rad);
    h.block<2, 2>(row, k) = sign * frame;
    h.block<2, 1>(row, k + 2) = sign * (frame * Eigen::Vector2d(-arm.y_m, arm.x_m));
    h(row + 2, k + 2) = sign;
  };
  for (std::size_t u = 1; u < units(); ++u) {
    const Index row = 3 * static_cast<Index>(u) - 3;
    put(row, to_first, u, 1.0);
    put(row, to_first, 0, -1.0);
    h(row, 2) += seen.read[row + 1];  // it is seen by the first, which turns
    h(row + 1, 2) -= seen.read[row];
  }
  if (reading.truth) put(of_joints, to_truth, 0, 1.0);
  if (reading.truth && wanders_) {
    h.block<2, 2>(of_joints, of_frame) = to_truth;
    h(of_joints + 2, of_frame + 2) = 1.0;
  }

  Small& err = seen.err;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostStates, 1> by(rows());
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
    const double variance = reading.held[j] * std::pow(noise.joint_steps * joint_step_[j], 2);
    err.noalias() += (variance * by) * by.transpose();
  }
  for (std::size_t u = 0; u < units(); ++u) {  // a count that is not full yet
    const double variance = count_m_[u] * count_m_[u] / 12.0, base_m = drives_[u].wheelbase_m;
    const auto k = 3 * static_cast<Index>(u);
    for (const double side : {-1.0, 1.0}) {
      by = h.middleCols(k, 3) *
           Eigen::Vector3d(0.5 * std::cos(at[u].heading_rad), 0.5 * std::sin(at[u].heading_rad), side / base_m);
      err.noalias() += (variance * by) * by.transpose();
    }
  }
  for (Index k = 0; k < of_joints; ++k) {
    const double apart = k % 3 == 2 ? noise.apart_m / drives_[0].wheelbase_m : noise.apart_m;
    err(k, k) += apart * apart;
  }
  err(of_joints, of_joints) += noise.truth_position_m * noise.truth_position_m;
  err(of_joints + 1, of_joints + 1) += noise.truth_position_m * noise.truth_position_m;
  err(of_joints + 2, of_joints + 2) += noise.truth_heading_rad * noise.truth_heading_rad;
}

// Outliers cost what the last sample does that is none: samples that are left out for nothing would make any noise
// likely that leaves out many.
bool JoinedFilter::is_taken(const Reading& reading, const Seen& seen, const Small& p, double& minus_two_log) const {
  if (!outliers_show_ || reading.is_believed) return true;
  const Index of_joints = rows() - 3;
  const Small h = seen.by_states.middleRows(of_joints, truth_rows_);
  const Small hp = h.lazyProduct(p);
  Small s = hp.lazyProduct(h.transpose());
  s += seen.err.block(of_joints, of_joints, truth_rows_, truth_rows_);
  const Eigen::LLT<Small> root(s);
  const VectorXd off = seen.read.segment(of_joints, truth_rows_);
  if (off.dot(root.solve(off)) < kGateOfTruth) return true;
  minus_two_log += kGateOfTruth;
  for (Index k = 0; k < truth_rows_; ++k) minus_two_log += 2.0 * std::log(root.matrixLLT()(k, k));
  return false;
}

bool JoinedFilter::is_lost(const Reading& reading, State& state) const {
  constexpr std::size_t kMostInARow = 8;
  state.refused.push_back(reading.of_tracked);
  if (state.refused.size() < kMostInARow) return false;
  Small rigid = Small::Zero(states(), 3);
  for (std::size_t u = 0; u < units(); ++u) {
    const Index k = 3 * static_cast<Index>(u);
    rigid.block<3, 3>(k, 0).setIdentity();
    rigid(k, 2) = -(state.at[u].y_m - state.at[0].y_m);
    rigid(k + 1, 2) = state.at[u].x_m - state.at[0].x_m;
  }
  const Eigen::Vector3d unknown2(kUnknown_m * kUnknown_m, kUnknown_m * kUnknown_m, kUnknown_rad * kUnknown_rad);
  state.p += rigid * unknown2.asDiagonal() * rigid.transpose();
  return true;
}

void JoinedFilter::put_anew(const Reading& reading, State& state) const {
  const Small before = state.p;
  put_units(state, state.at[0] * reading.unit_T_body[0], reading, true);
  state.p.topLeftCorner<3, 3>() = before.topLeftCorner<3, 3>();
  if (!wanders_) return;
  state.p.topRightCorner<3, 3>() = before.topRightCorner<3, 3>();
  state.p.bottomLeftCorner<3, 3>() = before.bottomLeftCorner<3, 3>();
  state.p.bottomRightCorner<3, 3>() = before.bottomRightCorner<3, 3>();
}

// What the units are off by is known against the first one, as it stands: corrected poses turn that with them, or
// joints that are read again and again would seem to tell where the room is (G. P. Huang, A. I. Mourikis and S. I.
// Roumeliotis, "Observability-based rules for designing consistent EKF SLAM estimators", International Journal of
// Robotics Research 29(5):502-528, 2010).
JoinedFilter::Small JoinedFilter::turned_with(const std::vector<Pose>& before, const std::vector<Pose>& after,
                                              const std::vector<Pose>& unit_T_body) const {
  Small turn = Small::Identity(states(), states());
  const auto swing = [&](const std::vector<Pose>& poses, std::size_t u) {  // of the body, by the unit's heading
    const Vec2 arm = rotated(unit_T_body[u].position(), poses[u].heading_rad);
    return Eigen::Vector2d(-arm.y_m, arm.x_m);
  };
  // The tracked point stays as well known as it was, wherever the first turns about it.
  const Eigen::Vector2d about = swing(before, 0) - swing(after, 0);
  turn.block<2, 1>(0, 2) = about;
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
    turn.block<2, 1>(k, 2) = about + swing(after, 0) - by * swing(before, 0) + apart(after) - by * apart(before);
  }
  return turn;
}

void JoinedFilter::correct(const Reading& reading, const Seen& seen, const VectorXd& off, State& state) const {
  std::vector<Pose>& at = state.at;
  const Index of_joints = rows() - 3, of_frame = rows();
  if (wanders_)
    state.wandered = {state.wandered.x_m + off[of_frame], state.wandered.y_m + off[of_frame + 1],
                      state.wandered.heading_rad + off[of_frame + 2]};
  // Where units stand against the first is linear in what they are off by; where they stand in the room is not, once
  // the first turns.
  const VectorXd apart = seen.read.head(of_joints) + seen.by_states.topRows(of_joints) * off;
  // The first turns about the tracked point, which is what is seen of it.
  const Vec2 arm = reading.unit_T_body[0].position(), out = rotated(arm, at[0].heading_rad);
  const Vec2 tracked = at[0].position() + out + Vec2{off[0] - out.y_m * off[2], off[1] + out.x_m * off[2]};
  const double heading_rad = at[0].heading_rad + off[2];
  const Vec2 axle = tracked - rotated(arm, heading_rad);
  at[0] = {axle.x_m, axle.y_m, heading_rad};
  const Pose body = at[0] * reading.unit_T_body[0];
  for (std::size_t u = 1; u < units(); ++u) {
    const Index k = 3 * static_cast<Index>(u);
    const double about_rad = at[u].heading_rad + off[k + 2];
    at[u] = body * Pose{apart[k - 3], apart[k - 2], apart[k - 1]} * inverse(reading.unit_T_body[u]);
    at[u].heading_rad = unwrapped(at[u].heading_rad, about_rad);
  }
}

double JoinedFilter::run(const JoinedNoise& noise, Wanted wanted) {
  wanders_ = noise.wander_m_per_sqrt_s > 0.0 || noise.wander_rad_per_sqrt_s > 0.0;
  wander_lasts_s_ = noise.wander_lasts_s;
  const bool keeps_steps = wanted == Wanted::columns;
  const Index n = rows(), of_joints = n - 3;
  if (keeps_steps) {
    steps_.resize(readings());
    residual_ = VectorXd::Zero(n * static_cast<Index>(readings()));
  }
  double minus_two_log = 0.0;
  contradicting_.clear();
  State state = begun(noise);
  Seen seen{{}, Small(n, states()), Small(n, n)};
  std::vector<Pose> predicted;
  for (std::size_t r = 0; r < readings(); ++r) {
    const Reading& reading = readings_[r];
    if (r > 0) go_on(r, noise, state);
    predicted = state.at;
    Step* step = keeps_steps ? &steps_[r] : nullptr;
    if (step) {
      step->starts = r == 0;
      step->count = 0;
      step->predicted = step->corrected = predicted;
      step->uncertain = state.p;
    }
    look(reading, noise, state, seen);
    if (reading.joints_are_read && r > 0 && are_torn_apart(seen.read, of_joints)) {
      put_anew(reading, state);  // what joins the units has jumped
      if (step) step->starts = true, step->predicted = step->corrected = state.at;
      continue;
    }
    // Either the joints, or the truth, or both: a block of rows. A truth that is contradicted all the time is right,
    // and the poses are lost.
    const Index from = reading.joints_are_read ? 0 : of_joints;
    const bool with_truth =
        reading.truth && (is_taken(reading, seen, state.p, minus_two_log) || is_lost(reading, state));
    if (with_truth && !state.refused.empty() && state.refused.back() == reading.of_tracked)
      contradicting_.push_back(state.refused);
    if (with_truth) state.refused.clear();
    const Index m = of_joints + (with_truth ? truth_rows_ : 0) - from;
    if (m <= 0) continue;
    const Small h = seen.by_states.middleRows(from, m);
    const Small ph = state.p.lazyProduct(h.transpose());
    Small s = h.lazyProduct(ph);
    s += seen.err.block(from, from, m, m);
    const Eigen::LLT<Small> root(s);
    const VectorXd white = root.matrixL().solve(-seen.read.segment(from, m));
    const Small gain = root.solve(ph.transpose()).transpose();
    for (Index a = 0; a < m; ++a) minus_two_log += white[a] * white[a] + 2.0 * std::log(root.matrixLLT()(a, a));
    const VectorXd off = gain * -seen.read.segment(from, m);
    state.p -= gain.lazyProduct(ph.transpose());
    correct(reading, seen, off, state);
    const Small turn = turned_with(predicted, state.at, reading.unit_T_body);
    const Small with_turn = turn.lazyProduct(state.p);
    state.p = with_turn.lazyProduct(turn.transpose());
    state.p = 0.5 * (state.p + state.p.transpose()).eval();
    if (!step) continue;
    residual_.segment(static_cast<Index>(r) * n + from, m) = white;
    step->corrected = state.at;
    step->whitener = root.matrixL().solve(Small::Identity(m, m));
    step->out = step->whitener.lazyProduct(h);
    step->first_row = from;
    step->count = m;
    step->gain = turn.lazyProduct(gain);
    step->on = turn - step->gain.lazyProduct(h);
  }
  if (!keeps_steps) return minus_two_log;
  for (Step& step : steps_) {
    step.room_R_corrected.clear();
    for (const Pose& at : step.corrected) step.room_R_corrected.push_back(turned(at.heading_rad));
  }
  return minus_two_log;
}

}  // namespace odolab
