#include "physics/ground.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace odolab {

namespace {

// A wheel of radius R over the top of an object of height h, whose top is `u` ahead of or behind the contact: the
// height of the wheel's centre above the flat, and how much of the rolled distance is horizontal. The higher centre
// decides.
struct Climb {
  double radius_m;
  double centre_height_m;  // of the highest object so far; R on the flat
  double horizontal_share = 1.0;

  bool meet(double u_m, double height_m) {
    if (std::abs(u_m) >= radius_m) return false;
    const double root = std::sqrt(radius_m * radius_m - u_m * u_m);
    if (height_m + root <= centre_height_m) return false;
    centre_height_m = height_m + root;
    horizontal_share = root / radius_m;
    return true;
  }
};

}  // namespace

double extra_roll_m(double radius_m, double height_m) {
  return 2.0 *
         (radius_m * std::acos(1.0 - height_m / radius_m) - std::sqrt(2.0 * radius_m * height_m - height_m * height_m));
}

Ground::Ground(const Floor& floor, Side inside, std::uint64_t seed) : floor_(floor), seed_(seed) {
  for (const Bump& bump : floor.bumps) {
    const bool on_inside = bump.under == Under::inside_wheel;
    PlacedBump placed;
    placed.centre = bump.centre;
    placed.along = {std::cos(bump.direction_rad), std::sin(bump.direction_rad)};
    placed.half_length_m = 0.5 * bump.length_m;
    placed.height_m = bump.height_m;
    placed.round = bump.round;
    placed.left =
        bump.under == Under::any_wheel || bump.under == Under::left_wheel || (on_inside && inside == Side::left);
    placed.right =
        bump.under == Under::any_wheel || bump.under == Under::right_wheel || (on_inside && inside == Side::right);
    if (bump.height_m > 0.0) bumps_.push_back(placed);
  }
}

Contact Ground::under(const WheelStance& stance) const {
  Contact contact;
  contact.friction = floor_.friction;
  for (const SlipZone& zone : floor_.slip_zones) {
    if (!contains(zone.shape, stance.contact)) continue;
    contact.in_slip_zone = true;
    if (zone.friction) contact.friction = *zone.friction;
    contact.slip = std::max(contact.slip, zone.slip);
  }

  Climb climb{stance.radius_m, stance.radius_m};
  if (!bumps_.empty()) {
    const Vec2 ahead{std::cos(stance.heading_rad), std::sin(stance.heading_rad)};
    for (const PlacedBump& bump : bumps_) {
      if (stance.side != Side::right && !bump.left) continue;
      if (stance.side != Side::left && !bump.right) continue;
      const Vec2 along = bump.round ? Vec2{-ahead.y_m, ahead.x_m} : bump.along;
      const double across = cross(ahead, along);
      if (std::abs(across) < 0.05) continue;  // the wheel runs along the cable, not over it
      const Vec2 from_contact = bump.centre - stance.contact;
      const double u = cross(from_contact, along) / across;  // way along the wheel's heading to the cable
      if (std::abs(u) >= stance.radius_m) continue;
      if (std::abs(dot(u * ahead - from_contact, along)) > bump.half_length_m) continue;
      if (climb.meet(u, bump.height_m)) contact.on_bump = true;
    }
  }
  if (floor_.roughness.largest_height_m > 0.0) {
    const double spacing_m = floor_.roughness.spacing_m;
    const double h = floor_.roughness.largest_height_m;
    const double reach_m = std::sqrt(2.0 * stance.radius_m * h - h * h);
    const std::uint64_t stream =
        seed_of_stream(seed_, 2 * static_cast<std::uint64_t>(stance.axle) + (stance.side == Side::left ? 1 : 2));
    const auto first = static_cast<std::int64_t>(std::ceil((stance.travelled_m - reach_m) / spacing_m));
    const auto last = static_cast<std::int64_t>(std::floor((stance.travelled_m + reach_m) / spacing_m));
    for (std::int64_t k = first; k <= last; ++k)
      climb.meet(static_cast<double>(k) * spacing_m - stance.travelled_m,
                 h * uniform_from_hash(mixed(stream + static_cast<std::uint64_t>(k))));
  }
  contact.horizontal_share = climb.horizontal_share;
  return contact;
}

}  // namespace odolab
