// What changes of the model do to a recording, epoch by epoch: JoinedColumn.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/together/joined_filter.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::Index;

}  // namespace

JoinedColumn JoinedFilter::nothing() const {
  JoinedColumn column;
  column.moved.resize(units());
  return column;
}

void JoinedFilter::cut_into_pieces() {
  pieces_.assign(units(), {});
  first_piece_.clear();
  std::vector<std::vector<Pose>> at_reading(units());
  for (std::size_t u = 0; u < units(); ++u)
    for (const Reading& r : readings_) at_reading[u].push_back(on_the_way(way_[u], r.time_s));
  std::size_t e = 0;
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    first_piece_.push_back(pieces_[0].size());
    const double from_s = samples_[i].time_s, to_s = samples_[i + 1].time_s;
    while (e + 2 < readings() && readings_[e + 1].time_s <= from_s) ++e;
    for (std::size_t k = e; k + 1 < readings() && readings_[k].time_s < to_s; ++k) {
      const double a = std::max(from_s, readings_[k].time_s), b = std::min(to_s, readings_[k + 1].time_s);
      if (b <= a) continue;
      for (std::size_t u = 0; u < units(); ++u) {
        const Pose here = on_the_way(way_[u], 0.5 * (a + b)), &start = at_reading[u][k];
        const double turn_rad = here.heading_rad - start.heading_rad;
        pieces_[u].push_back({static_cast<int>(k), (b - a) / (to_s - from_s), std::cos(turn_rad), std::sin(turn_rad),
                              rotated(at_reading[u][k + 1].position() - here.position(), -start.heading_rad)});
      }
    }
  }
  first_piece_.push_back(pieces_[0].size());
}

void JoinedFilter::add_motions(const Motions& motions, std::size_t unit, JoinedColumn& column) const {
  Eigen::Matrix3Xd& moved = column.moved[unit];
  if (moved.cols() == 0) moved = Eigen::Matrix3Xd::Zero(3, static_cast<Index>(readings() - 1));
  for (const Motions::Stretch& stretch : motions.stretches())
    for (std::size_t i = stretch.first; i < stretch.end && i + 1 < first_piece_.size(); ++i) {
      const BodyMotion m = motions[i];
      for (std::size_t p = first_piece_[i]; p < first_piece_[i + 1]; ++p) {
        const Piece& piece = pieces_[unit][p];
        moved(0, piece.epoch) +=
            piece.share * (piece.cosine * m.forward_m - piece.sine * m.sideways_m - piece.rest.y_m * m.turn_rad);
        moved(1, piece.epoch) +=
            piece.share * (piece.sine * m.forward_m + piece.cosine * m.sideways_m + piece.rest.x_m * m.turn_rad);
        moved(2, piece.epoch) += piece.share * m.turn_rad;
      }
    }
}

JoinedColumn JoinedFilter::by_wheels(std::size_t unit, int which) const {
  constexpr double kStep = 1e-5;
  DifferentialDrive drive = drives_[unit];
  (which == 0 ? drive.wheel_radius_left_m : which == 1 ? drive.wheel_radius_right_m : drive.wheelbase_m) *= 1.0 + kStep;
  const Track way = way_of(samples_, unit, drive);
  JoinedColumn column = nothing();
  Eigen::Matrix3Xd& moved = column.moved[unit];
  moved.resize(3, static_cast<Index>(readings() - 1));
  for (std::size_t e = 0; e + 1 < readings(); ++e) {
    const Pose then = between(on_the_way(way, readings_[e].time_s), on_the_way(way, readings_[e + 1].time_s));
    const Pose now =
        between(on_the_way(way_[unit], readings_[e].time_s), on_the_way(way_[unit], readings_[e + 1].time_s));
    moved.col(static_cast<Index>(e)) << then.x_m - now.x_m, then.y_m - now.y_m, then.heading_rad - now.heading_rad;
  }
  moved /= kStep;
  return column;
}

JoinedColumn JoinedFilter::by_length(const std::function<void(Vehicle&, double)>& add) const {
  constexpr double kStep = 1e-6;
  Vehicle other = vehicle_;
  add(other, kStep);
  JoinedColumn column = nothing();
  column.read.resize(rows(), static_cast<Index>(readings()));
  for (std::size_t r = 0; r < readings(); ++r) {
    const Reading& reading = readings_[r];
    // Where joints hold the others to the first: what they seem to be off by is noise, and a derivative that shares it
    // is led by it.
    std::vector<Pose> units = {steps_[r].predicted[0]};
    const Pose body = units[0] * reading.unit_T_body[0];
    for (std::size_t u = 1; u < this->units(); ++u) units.push_back(body * inverse(reading.unit_T_body[u]));
    column.read.col(static_cast<Index>(r)) = (read_at(units, units_T_body(other, reading.joints), reading.truth) -
                                              read_at(units, reading.unit_T_body, reading.truth)) /
                                             kStep;
  }
  return column;
}

JoinedColumn JoinedFilter::by_clock() const {
  JoinedColumn column = nothing();
  column.read = Eigen::MatrixXd::Zero(rows(), static_cast<Index>(readings()));
  const Track& way = way_[0];
  for (std::size_t r = 0; r < readings(); ++r) {
    if (!readings_[r].truth) continue;
    constexpr double kAside_s = 0.05;
    const double a = std::max(readings_[r].time_s - kAside_s, way.front().time_s),
                 b = std::min(readings_[r].time_s + kAside_s, way.back().time_s);
    if (b <= a) continue;
    // An offset that is larger has the truth's samples earlier on the wheels' clock.
    const auto body_at = [&](double time_s) {
      const Pose unit = steps_[r].predicted[0] * between(on_the_way(way, readings_[r].time_s), on_the_way(way, time_s));
      return unit * inverse(tracked_T_axle(vehicle_, 0, joints_at(samples_, time_s)));
    };
    const Pose before = between(*readings_[r].truth, body_at(a)), after = between(*readings_[r].truth, body_at(b));
    column.read.col(static_cast<Index>(r)).tail<3>() << (before.x_m - after.x_m) / (b - a),
        (before.y_m - after.y_m) / (b - a), (before.heading_rad - after.heading_rad) / (b - a);
  }
  return column;
}

}  // namespace odolab
