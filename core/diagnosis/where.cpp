#include "core/diagnosis/where.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/diagnosis/naming/intervals.h"

namespace odolab {

namespace {

constexpr double kEventRadius_m = 0.1;  // of what a wheel rolls over, and of what is hit
constexpr double kHalfWidthOf95 = 1.96;

double shape_named(const AcceptedEffect& a, const std::string& name) {
  for (std::size_t k = 0; k < a.effect->shapes.size(); ++k)
    if (a.effect->shapes[k].name == name) return a.shape[k];
  return 0.0;
}

bool has_shape(const AcceptedEffect& a, const std::string& name) {
  return std::any_of(a.effect->shapes.begin(), a.effect->shapes.end(), [&](const auto& s) { return s.name == name; });
}

double stderr_of_shape(const AcceptedEffect& a, const Eigen::MatrixXd& covariance, const std::string& name) {
  const std::vector<int> free = free_shapes(*a.effect);
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(a.value.size() + k);
    if (a.effect->shapes[free[k]].name == name && i < covariance.rows())
      return std::sqrt(std::max(0.0, covariance(i, i)));
  }
  return 0.0;
}

// Where the effect's part of the vehicle is: a wheel on the floor, or the axle's centre.
Vec2 place_of(const std::string& component, const EffectStep& s, double wheelbase_m) {
  const double side = component == "left_wheel"    ? 0.5 * wheelbase_m
                      : component == "right_wheel" ? -0.5 * wheelbase_m
                                                   : 0.0;
  return s.position + rotated({0.0, side}, s.heading_rad);
}

// Of what lies across the way.
struct CrossedLine {
  Vec2 along;
  double half_m;
};
std::optional<CrossedLine> line_of(const AcceptedEffect& a) {
  if (!has_shape(a, "length_m")) return std::nullopt;
  const double direction_rad = shape_named(a, "direction_rad");
  return CrossedLine{{std::cos(direction_rad), std::sin(direction_rad)}, 0.5 * shape_named(a, "length_m")};
}

// What comes at one time in each recording, where only one lasts until then: that one, and its own time.
struct OfOne {
  std::size_t run;
  double at_s;
};
std::optional<OfOne> only_one_with(const JointModel& joint, const AcceptedEffect& a) {
  if (a.effect->of_one_recording || a.effect->and_later_recordings || !has_shape(a, "at_s")) return std::nullopt;
  std::optional<OfOne> only;
  for (std::size_t r = 0; r < joint.views().size(); ++r) {
    const std::vector<EffectStep>& steps = joint.views()[r].steps;
    if (steps.empty()) continue;
    const double at_s = effects::put_on_s(shape_named(a, "at_s"), steps.front().time_s - steps.front().since_start_s);
    if (at_s <= steps.front().time_s || at_s >= steps.back().time_s) continue;
    if (only) return std::nullopt;
    only = OfOne{r, at_s};
  }
  return only;
}

}  // namespace

WhereFound where_of(const JointModel& joint, const AcceptedEffect& a, const Eigen::MatrixXd& covariance) {
  WhereFound w;
  w.regime = a.effect->regime;
  w.and_later_recordings = a.effect->and_later_recordings;
  const std::optional<OfOne> only = only_one_with(joint, a);
  if (only) w.regime = "from one time on";
  if (only || a.effect->of_one_recording || a.effect->and_later_recordings) {
    const auto run = only ? only->run : static_cast<std::size_t>(a.shape[0]);
    w.recording = joint.runs()[run].name;
    const double at_s = only ? only->at_s : shape_named(a, "at_s"),
                 wide_s = kHalfWidthOf95 * stderr_of_shape(a, covariance, "at_s");
    const std::vector<WheelSample>& wheels = joint.runs()[run].wheels;
    const double low_s = std::min(at_s, wheels.front().time_s), high_s = std::max(at_s, wheels.back().time_s);
    w.time_s.push_back({std::max(at_s - wide_s, low_s), std::min(at_s + wide_s, high_s)});
    const DriveView& view = joint.views()[run];
    if (a.effect->local && !view.steps.empty()) {
      std::size_t i = 0;
      while (i + 1 < view.steps.size() && view.steps[i].time_s < at_s) ++i;
      const Vec2 place = place_of(a.effect->component, view.steps[i], view.drive.wheelbase_m);
      w.zone = WhereFound::Zone{place.x_m, place.y_m, kEventRadius_m + std::abs(view.steps[i].speed_mps) * wide_s};
    }
  } else if (a.effect->local && has_shape(a, "x_m")) {
    const bool patch = has_shape(a, "radius_m");
    const std::optional<CrossedLine> line = line_of(a);
    const double radius_m = patch ? shape_named(a, "radius_m") : line ? line->half_m : kEventRadius_m;
    w.zone = WhereFound::Zone{shape_named(a, "x_m"), shape_named(a, "y_m"), radius_m};
    double longest_s = 0.0;
    std::vector<std::string> came;
    for (std::size_t r = 0; r < joint.runs().size(); ++r) {
      const DriveView& view = joint.views()[r];
      const double reach_m = radius_m + (patch || line ? 0.5 * view.drive.wheelbase_m : 0.0);  // either wheel
      std::vector<std::pair<double, double>> times;
      double in_all_s = 0.0;
      for (const EffectStep& s : view.steps) {
        const Vec2 away = place_of(a.effect->component, s, view.drive.wheelbase_m) - Vec2{w.zone->x_m, w.zone->y_m};
        if (length(away) > reach_m || (line && std::abs(cross(line->along, away)) > kEventRadius_m)) continue;
        const double from = s.time_s - 0.5 * s.duration_s, to = s.time_s + 0.5 * s.duration_s;
        if (!times.empty() && from - times.back().second < 0.2)
          times.back().second = to;
        else
          times.push_back({from, to});
        in_all_s += s.duration_s;
      }
      if (in_all_s > 0.0) came.push_back(joint.runs()[r].name);
      if (in_all_s > longest_s) longest_s = in_all_s, w.time_s = times, w.recording = joint.runs()[r].name;
    }
    for (std::string& name : came)
      if (name != w.recording) w.other_recordings.push_back(std::move(name));
  }
  return w;
}

bool overlap(const WhereFound::Zone& one, const WhereFound::Zone& other) {
  return length(Vec2{one.x_m, one.y_m} - Vec2{other.x_m, other.y_m}) < one.radius_m + other.radius_m;
}

}  // namespace odolab
