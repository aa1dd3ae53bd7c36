#include "core/diagnosis/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/base/quantile.h"
#include "core/calibration/evened_recording.h"
#include "core/calibration/left_out.h"
#include "core/diagnosis/encoder_jumps.h"

namespace odolab {

namespace {

// Wheels that would have done what was commanded: the calibration of radii and wheelbase is then that of the commands'
// scales.
void add_wheels_from_commands(Recording& recording, const DifferentialDrive& drive) {
  Channel left{"left_wheel_rad", {}}, right{"right_wheel_rad", {}};
  const Channel* v = recording.channel("command_speed_mps");
  const Channel* w = recording.channel("command_yaw_rate_radps");
  const double none = std::numeric_limits<double>::quiet_NaN();
  left.values.assign(recording.time_s.size(), none);
  right.values = left.values;
  double l = 0.0, r = 0.0, speed = 0.0, turn = 0.0, last_s = 0.0;
  bool any = false;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (!std::isfinite(v->values[i]) || !std::isfinite(w->values[i])) continue;
    if (any) {
      const double dt = recording.time_s[i] - last_s;
      l += (speed - 0.5 * drive.wheelbase_m * turn) * dt / drive.wheel_radius_left_m;
      r += (speed + 0.5 * drive.wheelbase_m * turn) * dt / drive.wheel_radius_right_m;
    }
    any = true;
    last_s = recording.time_s[i];
    speed = v->values[i];
    turn = w->values[i];
    left.values[i] = l;
    right.values[i] = r;
  }
  std::vector<Channel> others;
  for (Channel& c : recording.channels)
    if (c.name != left.name && c.name != right.name) others.push_back(std::move(c));
  others.push_back(std::move(left));
  others.push_back(std::move(right));
  recording.channels = std::move(others);
}

// "15.0 to 15.5 s", and how many more.
std::string times_text(const TimeStretches& times) {
  char text[120];
  std::snprintf(text, sizeof text, "from %.1f to %.1f s", times.front().first, times.front().second);
  std::string all = text;
  if (times.size() > 1) all += " and " + std::to_string(times.size() - 1) + " time(s) more";
  return all;
}

}  // namespace

CheckedRecording checked(const Recording& as_logged, const Vehicle& vehicle) {
  CheckedRecording out;
  const DifferentialDrive& drive = std::get<DifferentialDrive>(vehicle.kind);
  const std::optional<EvenedRecording> even = evened(as_logged, drive);
  if (even) out.warnings = even->said;
  const Recording& recording = even ? even->recording : as_logged;
  out.recording = recording;
  std::vector<WheelSample> wheels = wheel_samples(recording, drive);
  if (wheels.size() < 2 && recording.channel("command_speed_mps") && recording.channel("command_yaw_rate_radps")) {
    out.from_commands = true;
    add_wheels_from_commands(out.recording, drive);
    wheels = wheel_samples(out.recording, drive);
  }
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (wheels.size() < 4 || truth.size() < 4) return out;

  // Truth that repeats itself to the bit while the wheels turn.
  std::vector<double> rolled{0.0};
  for (std::size_t i = 1; i < wheels.size(); ++i)
    rolled.push_back(rolled.back() +
                     0.5 * drive.wheel_radius_left_m * std::abs(wheels[i].left_rad - wheels[i - 1].left_rad) +
                     0.5 * drive.wheel_radius_right_m * std::abs(wheels[i].right_rad - wheels[i - 1].right_rad));
  const auto at = [&](double time_s) {
    const auto it = std::lower_bound(wheels.begin(), wheels.end(), time_s,
                                     [](const WheelSample& w, double t) { return w.time_s < t; });
    return static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(it - wheels.begin(), static_cast<std::ptrdiff_t>(wheels.size()) - 1));
  };
  // Of a truth that is rounded, poses within one step of it are the same.
  double step_m = 0.01;
  for (std::size_t i = 1; i < truth.size(); ++i)
    if (const double by = std::abs(truth[i].position.x_m - truth[i - 1].position.x_m); by > 0.0)
      step_m = std::min(step_m, by);
  const double least_rolled_m = std::max(0.005, 2.0 * step_m);
  DataFault frozen{"truth_frozen", "truth", recording.name, {}, ""};
  TimeStretches repeated;  // at rest too, where it is a fault only of a truth that does so on the way
  for (std::size_t i = 0; i < truth.size();) {
    std::size_t j = i + 1;
    while (j < truth.size() && truth[j].position.x_m == truth[i].position.x_m &&
           truth[j].position.y_m == truth[i].position.y_m && truth[j].heading_rad == truth[i].heading_rad)
      ++j;
    if (j - i >= 3) repeated.push_back({truth[i].time_s, truth[j - 1].time_s});
    if (j - i >= 3 && rolled[at(truth[j - 1].time_s)] - rolled[at(truth[i].time_s)] > least_rolled_m)
      frozen.time_s.push_back(repeated.back());
    i = j;
  }
  if (!frozen.time_s.empty()) {
    frozen.time_s = repeated;
    std::size_t k = 0;
    for (Channel& c : out.recording.channels) {
      if (c.name.rfind("truth_", 0) != 0) continue;
      k = 0;
      for (std::size_t i = 0; i < out.recording.time_s.size(); ++i) {
        const double t = out.recording.time_s[i];
        while (k < frozen.time_s.size() && t > frozen.time_s[k].second) ++k;
        if (k < frozen.time_s.size() && t > frozen.time_s[k].first)
          c.values[i] = std::numeric_limits<double>::quiet_NaN();
      }
    }
    frozen.sentence = "the truth repeats itself with new stamps while the wheels turn, " +
                      std::to_string(frozen.time_s.size()) + " time(s); left out";
    out.faults.push_back(frozen);
  }
  if (out.from_commands) return out;

  if (const TimeStretches gaps = encoder_gaps(wheels); !gaps.empty()) {
    out.left_out_s = gaps;
    out.faults.push_back({"encoder_data_fault", "both_wheels", recording.name, gaps,
                          "no encoder readings " + times_text(gaps) + ", left out"});
  }

  // Encoders that stand still while the truth drives on, and single steps that no wheel could make.
  std::vector<double> second;
  for (std::size_t i = 1; i + 1 < truth.size(); ++i)
    second.push_back(std::abs(truth[i + 1].position.x_m - 2.0 * truth[i].position.x_m + truth[i - 1].position.x_m));
  const double noise = median(second) / 0.6745 / std::sqrt(6.0);
  const double least = 0.03 + 8.0 * noise;
  const auto truth_at = [&](double time_s) {
    const auto it = std::lower_bound(truth.begin(), truth.end(), time_s + vehicle.truth.time_offset_s,
                                     [](const TruthSample& t, double s) { return t.time_s < s; });
    return static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(it - truth.begin(), static_cast<std::ptrdiff_t>(truth.size()) - 1));
  };
  const bool headings = truth.front().heading_rad.has_value() && truth.back().heading_rad.has_value();
  const double truth_gap = (truth.back().time_s - truth.front().time_s) / static_cast<double>(truth.size() - 1);
  // In a gap of the truth the next sample says nothing of that time.
  const auto is_near = [&](std::size_t k, double time_s) {
    return std::abs(truth[k].time_s - vehicle.truth.time_offset_s - time_s) < 2.0 * truth_gap;
  };
  for (int wheel = 0; wheel < 2; ++wheel) {
    const auto rad = [&](std::size_t i) { return wheel == 0 ? wheels[i].left_rad : wheels[i].right_rad; };
    const double radius = wheel == 0 ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
    DataFault fault{"encoder_data_fault", wheel == 0 ? "left_wheel" : "right_wheel", recording.name, {}, ""};
    double count_rad = 1e9;
    for (std::size_t i = 0; i + 1 < wheels.size(); ++i)
      if (const double by = std::abs(rad(i + 1) - rad(i)); by > 0.0) count_rad = std::min(count_rad, by);
    for (std::size_t i = 0; i + 1 < wheels.size();) {
      std::size_t j = i + 1;
      while (j < wheels.size() && rad(j) == rad(i)) ++j;
      --j;
      if (j > i + 3 && wheels[j].time_s - wheels[i].time_s > std::max(0.15, 1.5 * truth_gap)) {
        // The wheel's own way by the truth: of the centre, and half the base times the turn.
        const std::size_t a = truth_at(wheels[i].time_s), b = truth_at(wheels[j].time_s);
        double way = 0.0;
        if (b > a && is_near(a, wheels[i].time_s) && is_near(b, wheels[j].time_s)) {
          const Vec2 d = truth[b].position - truth[a].position;
          if (headings && truth[a].heading_rad && truth[b].heading_rad) {
            const double h0 = *truth[a].heading_rad - vehicle.truth.axle_T_tracked.heading_rad,
                         turn = *truth[b].heading_rad - *truth[a].heading_rad;
            const double forward = dot(d, Vec2{std::cos(h0 + 0.5 * turn), std::sin(h0 + 0.5 * turn)});
            way = forward + (wheel == 0 ? -0.5 : 0.5) * drive.wheelbase_m * turn;
          } else if (wheels[i].left_rad == wheels[j].left_rad && wheels[i].right_rad == wheels[j].right_rad) {
            way = length(d);
          }
        }
        const double span = wheels[j].time_s - wheels[i].time_s;
        const std::size_t i0 = at(wheels[i].time_s - 0.3);
        const double before =
            radius * std::abs(rad(i) - rad(i0)) / std::max(wheels[i].time_s - wheels[i0].time_s, 1e-3);
        if (std::abs(way) > least + 2.0 * count_rad * radius && before > 0.4 * std::abs(way) / span)
          fault.time_s.push_back({wheels[i].time_s, j + 1 < wheels.size() ? wheels[j + 1].time_s : wheels[j].time_s});
      }
      i = j > i ? j : i + 1;
    }
    // Readings that hold and then catch up at once: no wheel does that, whatever the truth says.
    for (std::size_t i = 5; i + 1 < wheels.size();) {
      std::size_t j = i;
      while (j + 1 < wheels.size() && rad(j + 1) == rad(i)) ++j;
      if (j >= i + 3 && j + 1 < wheels.size()) {
        const std::size_t end = std::min(j + 6, wheels.size() - 1);
        const double before = (rad(i) - rad(i - 5)) / 5.0, next = rad(j + 1) - rad(j),
                     after = (rad(end) - rad(j + 1)) / std::max(1.0, static_cast<double>(end - j - 1));
        if (std::abs(next) > 5.0 * count_rad && std::abs(next) > 3.0 * std::max(std::abs(before), std::abs(after)) &&
            wheels[j + 1].time_s - wheels[j].time_s < 0.5)
          fault.time_s.push_back({wheels[i].time_s, wheels[j + 1].time_s});
      }
      i = j + 1;
    }
    std::vector<double> time_s, angle_rad;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      time_s.push_back(wheels[i].time_s);
      angle_rad.push_back(rad(i));
    }
    for (const auto& jump : encoder_jumps(time_s, angle_rad, radius, count_rad)) fault.time_s.push_back(jump);
    if (fault.time_s.empty()) continue;
    fault.time_s = joined(std::move(fault.time_s));
    for (const auto& t : fault.time_s) out.left_out_s.push_back(t);
    fault.sentence = std::string("the ") + (wheel == 0 ? "left" : "right") +
                     " encoder stands still or jumps while the vehicle drives on, " +
                     std::to_string(fault.time_s.size()) + " time(s); left out";
    out.faults.push_back(fault);
  }
  out.left_out_s = joined(std::move(out.left_out_s));
  return out;
}

}  // namespace odolab
