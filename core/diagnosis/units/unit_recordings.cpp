#include "core/diagnosis/units/unit_recordings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnosis/units/drawn_joints.h"

namespace odolab {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// Truth samples for each encoder sample: fewer, and two readings would share one, so the truth's times are taken.
constexpr double kSharedNone = 2.0;

struct Row {
  double time_s = 0.0;
  double left_rad = kNone, right_rad = kNone;
  double x_m = kNone, y_m = kNone, heading_rad = kNone;
};

Recording recording_by_rows(std::vector<Row> rows, const Recording& from) {
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.time_s < b.time_s; });
  Recording recording;
  recording.name = from.name;
  recording.provenance = from.provenance;
  for (const Row& row : rows) recording.time_s.push_back(row.time_s);
  const auto add = [&](const char* name, double Row::*value) {
    Channel& channel = recording.add_channel(name);
    for (std::size_t i = 0; i < rows.size(); ++i) channel.values[i] = rows[i].*value;
  };
  add("left_wheel_rad", &Row::left_rad);
  add("right_wheel_rad", &Row::right_rad);
  add("truth_x_m", &Row::x_m);
  add("truth_y_m", &Row::y_m);
  if (std::any_of(rows.begin(), rows.end(), [](const Row& row) { return std::isfinite(row.heading_rad); }))
    add("truth_heading_rad", &Row::heading_rad);
  return recording;
}

// Between readings that are so far apart that nobody knows what joints did meanwhile.
bool is_in_gap(const std::vector<UnitSample>& samples, double time_s) {
  constexpr double kPeriods = 2.5, kLeast_s = 0.1;
  const auto after = std::lower_bound(samples.begin(), samples.end(), time_s,
                                      [](const UnitSample& s, double t) { return s.time_s < t; });
  if (after == samples.begin() || after == samples.end()) return false;
  const double usual_s = (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
  return after->time_s - (after - 1)->time_s > std::max(kLeast_s, kPeriods * usual_s);
}

std::size_t nearest(const std::vector<UnitSample>& samples, double time_s) {
  const auto after = std::lower_bound(samples.begin(), samples.end(), time_s,
                                      [](const UnitSample& s, double t) { return s.time_s < t; });
  const auto k = static_cast<std::size_t>(after - samples.begin());
  if (k == 0 || k == samples.size()) return k == 0 ? 0 : k - 1;
  return samples[k].time_s - time_s < time_s - samples[k - 1].time_s ? k : k - 1;
}

Row pose_row(double time_s, const Pose& pose) { return {time_s, kNone, kNone, pose.x_m, pose.y_m, pose.heading_rad}; }

}  // namespace

Vehicle vehicle_of_unit(const VehicleUnit& unit, const Vehicle& vehicle) {
  Vehicle one;
  one.name = unit.name.empty() ? vehicle.name : unit.name;
  one.kind = unit.drive;
  if (unit.carries_truth) one.truth = vehicle.truth;
  return one;
}

Recording recording_of_unit(const Recording& recording, const std::vector<UnitSample>& samples, const Track& tracked,
                            const Vehicle& vehicle, std::size_t unit, double clock_s, bool by_joints) {
  std::vector<Row> rows;
  for (const UnitSample& s : samples) rows.push_back({s.time_s, s.wheels[unit].left_rad, s.wheels[unit].right_rad});
  if (!by_joints) {
    for (const TruthSample& t : truth_samples(recording))
      rows.push_back({t.time_s, kNone, kNone, t.position.x_m, t.position.y_m, t.heading_rad.value_or(kNone)});
    return recording_by_rows(std::move(rows), recording);
  }
  const std::vector<UnitSample> joined = with_joints_drawn(samples);
  const double offset_s = vehicle.truth.time_offset_s + clock_s;
  const bool is_faster = tracked.size() > samples.size();  // then two of its samples would share a joint's reading
  const bool at_truth = static_cast<double>(tracked.size()) < kSharedNone * static_cast<double>(samples.size());
  if (at_truth) {
    std::size_t last_near = samples.size();
    for (const TimedPose& t : tracked) {
      const double at_s = t.time_s - offset_s;
      if (samples.empty() || at_s < samples.front().time_s || at_s > samples.back().time_s) continue;
      if (is_in_gap(samples, at_s)) continue;
      const std::size_t near = nearest(samples, at_s);
      if (is_faster && near == last_near) continue;
      last_near = near;
      rows.push_back(pose_row(at_s, t.pose * tracked_T_axle(vehicle, unit, joints_at(joined, at_s))));
    }
  } else {
    // Not across gaps: a pose between two truth samples is one of them, nearly.
    const double period_s = (tracked.back().time_s - tracked.front().time_s) / static_cast<double>(tracked.size() - 1);
    std::size_t k = 0;
    for (const UnitSample& s : joined) {
      const double at_s = s.time_s + offset_s;
      while (k + 1 < tracked.size() && tracked[k + 1].time_s < at_s) ++k;
      if (k + 1 >= tracked.size() || at_s < tracked[k].time_s) continue;
      if (tracked[k + 1].time_s - tracked[k].time_s > 2.5 * period_s) continue;
      const Pose pose = *pose_at({tracked[k], tracked[k + 1]}, at_s);
      rows.push_back(pose_row(s.time_s, pose * tracked_T_axle(vehicle, unit, s.joints)));
    }
  }
  return recording_by_rows(std::move(rows), recording);
}

}  // namespace odolab
