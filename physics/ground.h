// What a wheel finds where it touches the floor.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scenario/floor.h"

namespace odolab {

// A wheel in the middle meets only what lies under every wheel.
enum class Side { left, right, middle };

struct Contact {
  double friction = 0.8;
  double slip = 0.0;  // share of the rolled distance that is lost
  // Horizontal travel per rolled distance: 1 on the flat, the cosine of the climb on a bump (README, Eq. 5).
  double horizontal_share = 1.0;
  bool on_bump = false;  // a bump of the floor's list; roughness does not count
  bool in_slip_zone = false;
};

// Where and how a wheel stands.
struct WheelStance {
  Side side = Side::left;
  Vec2 contact;              // on the floor
  double heading_rad = 0.0;  // rolling direction
  double radius_m = 0.075;
  double travelled_m = 0.0;  // signed way of the contact along the wheel since the start: it selects the roughness
  int axle = 0;              // each axle of a vehicle meets roughness of its own
};

class Ground {
 public:
  // `inside` is the side that bumps under the inside wheel act on. `seed` draws the roughness.
  Ground(const Floor& floor, Side inside, std::uint64_t seed);

  Contact under(const WheelStance& stance) const;

 private:
  struct PlacedBump {
    Vec2 centre, along;
    double half_length_m, height_m;
    bool left, right, round;
  };

  Floor floor_;
  std::vector<PlacedBump> bumps_;
  std::uint64_t seed_;
};

// How much further a wheel turns than it travels over an object of the given height, as a distance:
// 2 (R acos(1 - h/R) - sqrt(2 R h - h^2)). 3.5 mm for R = 75 mm, h = 10 mm.
double extra_roll_m(double radius_m, double height_m);

}  // namespace odolab
