#include "core/scenario/floor.h"

#include "core/base/formatted.h"

namespace odolab {

namespace {

struct Contains {
  Vec2 point;

  bool operator()(const Disc& disc) const { return length(point - disc.centre) <= disc.radius_m; }

  bool operator()(const Rectangle& rectangle) const {
    const Vec2 p = rotated(point - rectangle.centre, -rectangle.direction_rad);
    return std::abs(p.x_m) <= 0.5 * rectangle.width_m && std::abs(p.y_m) <= 0.5 * rectangle.height_m;
  }

  // A ray to the right crosses the outline an odd number of times.
  bool operator()(const Polygon& polygon) const {
    bool inside = false;
    const std::vector<Vec2>& c = polygon.corners;
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) {
      if ((c[i].y_m > point.y_m) == (c[j].y_m > point.y_m)) continue;
      const double x = c[j].x_m + (point.y_m - c[j].y_m) / (c[i].y_m - c[j].y_m) * (c[i].x_m - c[j].x_m);
      if (point.x_m < x) inside = !inside;
    }
    return inside;
  }
};

std::string sentence(const std::string& key, double found, const char* expected) {
  return key + formatted(": found %g, expected ", found) + expected;
}

struct ShapeProblem {
  std::string key;

  std::string operator()(const Disc& disc) const {
    return disc.radius_m > 0.0 ? "" : sentence(key + ".radius_m", disc.radius_m, "a length above 0 m");
  }
  std::string operator()(const Rectangle& r) const {
    if (!(r.width_m > 0.0)) return sentence(key + ".width_m", r.width_m, "a length above 0 m");
    return r.height_m > 0.0 ? "" : sentence(key + ".height_m", r.height_m, "a length above 0 m");
  }
  std::string operator()(const Polygon& p) const {
    return p.corners.size() >= 3
               ? ""
               : sentence(key + ".corners", static_cast<double>(p.corners.size()), "three corners or more");
  }
};

}  // namespace

bool contains(const Shape& shape, Vec2 point) { return std::visit(Contains{point}, shape); }

Shape moved(const Shape& shape, Vec2 by) {
  Shape result = shape;
  if (auto* disc = std::get_if<Disc>(&result)) disc->centre = disc->centre + by;
  if (auto* rectangle = std::get_if<Rectangle>(&result)) rectangle->centre = rectangle->centre + by;
  if (auto* polygon = std::get_if<Polygon>(&result))
    for (Vec2& c : polygon->corners) c = c + by;
  return result;
}

std::vector<std::string> problems_in(const Floor& floor) {
  std::vector<std::string> problems;
  if (!(floor.friction >= 0.0))
    problems.push_back(sentence("floor.friction", floor.friction, "a coefficient of 0 or more"));
  if (!(std::abs(floor.tilt_rad) < 0.5))
    problems.push_back(sentence("floor.tilt_rad", floor.tilt_rad, "an angle within 0.5 rad"));
  if (!(floor.roughness.largest_height_m >= 0.0 && floor.roughness.largest_height_m < 0.02))
    problems.push_back(sentence("floor.roughness.largest_height_m", floor.roughness.largest_height_m, "0 to 0.02 m"));
  if (!(floor.roughness.spacing_m >= 0.001))
    problems.push_back(sentence("floor.roughness.spacing_m", floor.roughness.spacing_m, "0.001 m or more"));
  for (std::size_t i = 0; i < floor.bumps.size(); ++i) {
    const std::string key = "floor.bump[" + std::to_string(i + 1) + "]";
    if (!(floor.bumps[i].height_m >= 0.0 && floor.bumps[i].height_m <= 0.05))
      problems.push_back(sentence(key + ".height_m", floor.bumps[i].height_m, "0 to 0.05 m"));
    if (!(floor.bumps[i].length_m > 0.0))
      problems.push_back(sentence(key + ".length_m", floor.bumps[i].length_m, "a length above 0 m"));
  }
  for (std::size_t i = 0; i < floor.slip_zones.size(); ++i) {
    const std::string key = "floor.slip_zone[" + std::to_string(i + 1) + "]";
    const SlipZone& zone = floor.slip_zones[i];
    if (zone.friction && !(*zone.friction >= 0.0))
      problems.push_back(sentence(key + ".friction", *zone.friction, "a coefficient of 0 or more"));
    if (!(zone.slip >= 0.0 && zone.slip <= 1.0))
      problems.push_back(sentence(key + ".slip", zone.slip, "a share from 0 to 1"));
    const std::string problem = std::visit(ShapeProblem{key}, zone.shape);
    if (!problem.empty()) problems.push_back(problem);
  }
  return problems;
}

}  // namespace odolab
