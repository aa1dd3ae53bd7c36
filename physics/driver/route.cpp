#include "physics/driver/route.h"

#include <cmath>

namespace odolab {

namespace {

// Adds legs at the end of a route.
struct RouteBuilder {
  Pose pose;
  std::vector<Leg> legs;

  void add(Leg leg) {
    leg.from = pose;
    legs.push_back(leg);
    pose = leg.end();
  }
  void line(double length_m) { add({Leg::Kind::line, {}, length_m, 0.0, true}); }
  void turn(double turn_rad) { add({Leg::Kind::turn, {}, 0.0, turn_rad, true}); }
  void arc(double radius_m, double turn_rad, bool stops) {
    add({Leg::Kind::arc, {}, radius_m * std::abs(turn_rad), turn_rad, stops});
  }
};

struct Legs {
  RouteBuilder& route;

  void operator()(const SquarePath& square) const {
    for (int side = 0; side < 4; ++side) {  // the fourth turn comes after the return (report, section 3.5)
      route.line(square.side_m);
      route.turn(square.clockwise ? -0.5 * kPi : 0.5 * kPi);
    }
  }
  void operator()(const StraightPath& straight) const {
    route.line(straight.length_m);
    if (straight.there_and_back) route.line(-straight.length_m);
  }
  void operator()(const FigureEightPath& eight) const {
    for (int loop = 0; loop < eight.loops; ++loop) {
      route.arc(eight.radius_m, 2.0 * kPi, false);
      route.arc(eight.radius_m, -2.0 * kPi, loop + 1 == eight.loops);
    }
  }
  void operator()(const WaypointPath& way) const {
    for (const Vec2 point : way.points) {
      const Vec2 ahead = point - route.pose.position();
      if (length(ahead) < 1e-6) continue;
      const double turn_rad = wrapped(std::atan2(ahead.y_m, ahead.x_m) - route.pose.heading_rad);
      if (std::abs(turn_rad) > 1e-9) route.turn(turn_rad);
      route.line(length(ahead));
    }
  }
  void operator()(const RectanglePath& rectangle) const {
    const double r = rectangle.corner_radius_m;
    for (int side = 0; side < 4; ++side) {
      route.add({Leg::Kind::line, {}, (side % 2 == 0 ? rectangle.length_m : rectangle.width_m) - 2.0 * r, 0.0, false});
      route.arc(r, rectangle.clockwise ? -0.5 * kPi : 0.5 * kPi, side == 3);
    }
  }
  void operator()(const ManoeuvrePath& path) const {
    for (const Manoeuvre& move : path.moves) {
      const double way_m = std::hypot(move.forward_m, move.left_m);
      if (way_m > 0.0) route.add({Leg::Kind::shift, {}, way_m, 0.0, true, std::atan2(move.left_m, move.forward_m)});
      if (move.turn_rad != 0.0) route.turn(move.turn_rad);
    }
  }
  template <typename Other>
  void operator()(const Other&) const {}
};

}  // namespace

Pose Leg::end() const {
  switch (kind) {
    case Kind::line:
      return from * Pose{length_m, 0.0, 0.0};
    case Kind::turn:
      return from * Pose{0.0, 0.0, turn_rad};
    case Kind::shift:
      return from * Pose{length_m * std::cos(direction_rad), length_m * std::sin(direction_rad), 0.0};
    case Kind::arc:
      break;
  }
  const double radius_m = length_m / turn_rad;  // signed: the centre lies to the left where positive
  return from * Pose{radius_m * std::sin(turn_rad), radius_m * (1.0 - std::cos(turn_rad)), turn_rad};
}

std::vector<Leg> route_of(const Path& path, const Pose& start) {
  RouteBuilder route{start, {}};
  std::visit(Legs{route}, path);
  return route.legs;
}

double duration_of(const std::vector<Leg>& route, const Driving& driving) {
  double sum_s = 0.0;
  for (const Leg& leg : route)
    sum_s += leg.kind == Leg::Kind::turn
                 ? std::abs(leg.turn_rad) / driving.turn_rate_radps +
                       driving.turn_rate_radps / driving.turn_acceleration_radps2
                 : std::abs(leg.length_m) / driving.speed_mps + driving.speed_mps / driving.acceleration_mps2;
  return sum_s + 0.3 * static_cast<double>(route.size());
}

}  // namespace odolab
