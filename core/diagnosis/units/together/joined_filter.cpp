#include "core/diagnosis/units/together/joined_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/outside_truth.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEpoch_s = 0.075;  // and more, from one reading of the joints to the next that is looked at

bool read_alike(const UnitSample& a, const UnitSample& b) {
  return a.joints == b.joints && std::equal(a.wheels.begin(), a.wheels.end(), b.wheels.begin(), [](auto l, auto r) {
           return l.left_rad == r.left_rad && l.right_rad == r.right_rad;
         });
}

// Which samples are looked at: one in each epoch. At rest what is read is rounded as it was before, again and again:
// the first and the last of it.
std::vector<char> say_more(const std::vector<UnitSample>& samples) {
  std::vector<std::size_t> each;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (each.empty() || samples[i].time_s >= samples[each.back()].time_s + kEpoch_s) each.push_back(i);
  std::vector<char> more(samples.size(), 0);
  for (std::size_t k = 0; k < each.size(); ++k) {
    const bool as_before = k > 0 && read_alike(samples[each[k - 1]], samples[each[k]]),
               as_behind = k + 1 < each.size() && read_alike(samples[each[k]], samples[each[k + 1]]);
    more[each[k]] = !as_before || !as_behind;
  }
  return more;
}

}  // namespace

JoinedFilter::JoinedFilter(const JoinedRun& run, const Vehicle& vehicle, double clock_s)
    : vehicle_(vehicle),
      samples_(run.samples),
      truth_rows_(run.has_headings ? 3 : 2),
      outliers_show_(comes_often(run.tracked)) {
  for (std::size_t u = 0; u < samples_.front().wheels.size(); ++u) {
    drives_.push_back(units_of(vehicle_)[u].drive);
    way_.push_back(way_of(samples_, u, drives_.back()));
  }
  joint_step_ = joint_steps(vehicle_);
  for (const DifferentialDrive& d : drives_)
    count_m_.push_back(2.0 * kPi * 0.5 * (d.wheel_radius_left_m + d.wheel_radius_right_m) / d.counts_per_wheel_turn());
  const double late_s = vehicle_.truth.time_offset_s + clock_s;
  std::size_t t = 0;
  while (t < run.tracked.size() && run.tracked[t].time_s - late_s < samples_.front().time_s) ++t;
  const std::vector<char> says_more = say_more(samples_);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const UnitSample& s = samples_[i];
    for (; t < run.tracked.size() && run.tracked[t].time_s - late_s <= s.time_s; ++t) {
      const double at_s = run.tracked[t].time_s - late_s;
      const bool is_believed = std::find(run.believed.begin(), run.believed.end(), t) != run.believed.end();
      readings_.push_back({at_s, joints_at(samples_, at_s), run.tracked[t].pose, false, t, is_believed, {}, {}});
    }
    if (!says_more[i]) continue;
    if (!readings_.empty() && readings_.back().time_s == s.time_s)
      readings_.back().joints_are_read = true;
    else
      readings_.push_back({s.time_s, s.joints, std::nullopt, true, 0, false, {}, {}});
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
  count_what_is_held();
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

double JoinedFilter::kept_of_frame(std::size_t reading) const {
  return wander_lasts_s_ > 0.0
             ? std::exp(-(readings_[reading].time_s - readings_[reading - 1].time_s) / wander_lasts_s_)
             : 1.0;
}

void JoinedFilter::count_what_is_held() {
  constexpr std::ptrdiff_t kMostPassed = 10;
  for (std::size_t j = 0; j < joint_step_.size(); ++j) {
    std::vector<Reading*> read;
    for (Reading& reading : readings_)
      if (reading.joints_are_read) read.push_back(&reading);
    const auto reads = [&](std::size_t k) { return read[k]->joints[j]; };
    for (std::size_t first = 0, end = 0; first < read.size(); first = end) {
      while (end < read.size() && reads(end) == reads(first)) ++end;
      const bool is_passed =
          first > 0 && end < read.size() && (reads(first) - reads(first - 1)) * (reads(end) - reads(first)) > 0.0;
      const auto count = static_cast<std::ptrdiff_t>(end - first);
      const double held = is_passed && count <= kMostPassed ? 1.0 : static_cast<double>(count);
      for (std::size_t k = first; k < end; ++k) read[k]->held.push_back(held);
    }
  }
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
    if (r > 0 && wanders_) off.bottomRows(3) *= kept_of_frame(r);
    if (r > 0)
      for (std::size_t u = 0; u < units(); ++u) {
        const auto k = 3 * static_cast<Index>(u);
        const Pose& before = steps_[r - 1].corrected[u];
        const Vec2 ahead = step.predicted[u].position() - before.position();
        off.row(k) -= ahead.y_m * off.row(k + 2);
        off.row(k + 1) += ahead.x_m * off.row(k + 2);
        const Eigen::Matrix2d& room = steps_[r - 1].room_R_corrected[u];
        for (Index c = 0; c < count; ++c) {
          const JoinedColumn& column = columns[static_cast<std::size_t>(c)];
          if (column.moved.empty() || column.moved[u].cols() == 0) continue;
          const Eigen::Vector3d m = column.moved[u].col(static_cast<Index>(r) - 1);
          off.block<2, 1>(k, c) += room * m.head<2>();
          off(k + 2, c) += m[2];
        }
      }
    if (step.starts && r > 0) {
      // The units are put anew where the first one and the joints say: what the first is off by, all are.
      for (Index c = 0; c < count; ++c)
        for (std::size_t u = 1; u < units(); ++u) off.col(c).segment<3>(3 * static_cast<Index>(u)).setZero();
      continue;
    }
    if (step.count == 0) continue;
    auto here = out.middleRows(static_cast<Index>(r) * n + step.first_row, step.count);
    here.noalias() = step.out.lazyProduct(off);  // too small to be packed for
    passed.noalias() = step.on.lazyProduct(off);
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
