#include "app/gui/planned_path.h"

namespace odolab {

namespace {

// In the frame of the start, the robot looking along x.
struct Line {
  std::vector<Vec2> operator()(const SquarePath& p) const {
    const double s = p.side_m, y = p.clockwise ? -s : s;
    return {{0, 0}, {s, 0}, {s, y}, {0, y}, {0, 0}};
  }
  std::vector<Vec2> operator()(const StraightPath& p) const { return {{0, 0}, {p.length_m, 0}}; }
  std::vector<Vec2> operator()(const FigureEightPath& p) const {
    std::vector<Vec2> line;
    constexpr int kParts = 90;
    for (const double side : {1.0, -1.0})
      for (int i = 0; i <= kParts; ++i) {
        const double angle = 2.0 * kPi * i / kParts;
        line.push_back({p.radius_m * std::sin(angle), side * p.radius_m * (1.0 - std::cos(angle))});
      }
    return line;
  }
  std::vector<Vec2> operator()(const WaypointPath& p) const {
    std::vector<Vec2> line{{0, 0}};
    line.insert(line.end(), p.points.begin(), p.points.end());
    return line;
  }
  std::vector<Vec2> operator()(const WheelSpeedPath&) const { return {}; }
  std::vector<Vec2> operator()(const HandPath&) const { return {}; }
  std::vector<Vec2> operator()(const RectanglePath& p) const {
    const double r = p.corner_radius_m, side = p.clockwise ? -1.0 : 1.0;
    std::vector<Vec2> line{{0, 0}};
    Pose pose;
    constexpr int kParts = 12;
    for (int k = 0; k < 4; ++k) {
      pose = pose * Pose{(k % 2 == 0 ? p.length_m : p.width_m) - 2.0 * r, 0.0, 0.0};
      for (int i = 0; i <= kParts; ++i) {
        const double angle = 0.5 * kPi * i / kParts;
        line.push_back(pose * Vec2{r * std::sin(angle), side * r * (1.0 - std::cos(angle))});
      }
      pose = pose * Pose{r, side * r, side * 0.5 * kPi};
    }
    return line;
  }
  std::vector<Vec2> operator()(const ManoeuvrePath& p) const {
    std::vector<Vec2> line{{0, 0}};
    Pose pose;
    for (const Manoeuvre& move : p.moves) {
      pose = pose * Pose{move.forward_m, move.left_m, move.turn_rad};
      line.push_back(pose.position());
    }
    return line;
  }
  std::vector<Vec2> operator()(const ReplayPath&) const { return {}; }
};

}  // namespace

std::vector<Vec2> planned_path(const Scenario& scenario, const Pose& start) {
  std::vector<Vec2> line = std::visit(Line{}, scenario.path);
  const bool on_the_floor = std::holds_alternative<WaypointPath>(scenario.path);
  if (on_the_floor)
    line.front() = start.position();
  else
    for (Vec2& p : line) p = start * p;
  return line;
}

}  // namespace odolab
