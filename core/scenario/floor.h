// The floor a vehicle drives on: friction, tilt, roughness, cables and slippery patches.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

// Which wheels a bump acts on. The inside wheel faces the inside of the square path: left when driven
// counter-clockwise.
enum class Under { any_wheel, left_wheel, right_wheel, inside_wheel };

// A straight cable on the floor, or something round that lies across every way. A wheel that climbs it turns further
// than it travels.
struct Bump {
  Vec2 centre;
  double direction_rad = 0.5 * kPi;  // along the cable
  double length_m = 1.0;
  double height_m = 0.010;  // the household cable of the extended UMBmark
  Under under = Under::any_wheel;
  bool round = false;  // faces every wheel squarely, `length_m` wide; it has no direction
};

struct Disc {
  Vec2 centre;
  double radius_m = 0.5;
};

struct Rectangle {
  Vec2 centre;
  double width_m = 1.0;   // along x before it is turned
  double height_m = 1.0;  // along y before it is turned
  double direction_rad = 0.0;
};

struct Polygon {
  std::vector<Vec2> corners;  // three or more, in order, either way round
};

using Shape = std::variant<Disc, Rectangle, Polygon>;

bool contains(const Shape& shape, Vec2 point);
Shape moved(const Shape& shape, Vec2 by);

// A patch where wheels grip less, or slip by a fixed share of what they roll.
struct SlipZone {
  Shape shape = Disc{};
  std::optional<double> friction;  // instead of the floor's coefficient
  double slip = 0.0;               // share of the rolled distance that is lost, 0 to 1
};

// A bump of random height under each drive wheel every few centimetres (UMBmark report, section 4.6.2: 0-1 mm, 2 cm).
struct Roughness {
  double largest_height_m = 0.0;  // 0: a smooth floor
  double spacing_m = 0.02;
};

struct Floor {
  double friction = 0.8;
  double tilt_rad = 0.0;
  double downhill_direction_rad = 0.0;
  Roughness roughness;
  std::vector<Bump> bumps;
  std::vector<SlipZone> slip_zones;
};

std::vector<std::string> problems_in(const Floor& floor);

}  // namespace odolab
