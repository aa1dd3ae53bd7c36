#include "core/vehicle/multi_castor.h"

#include <cmath>

#include "core/vehicle/demands.h"

namespace odolab {

std::vector<std::string> problems_in(const MultiCastor& v) {
  Demands demands;
  demands.zero_or_more("wheel_encoder_resolution_rad", v.wheel_encoder_resolution_rad, "an angle");
  demands.within("wheel_encoder_resolution_rad", v.wheel_encoder_resolution_rad, 1.0, "an angle in radians");
  demands.zero_or_more("pivot_encoder_resolution_rad", v.pivot_encoder_resolution_rad, "an angle");
  demands.within("pivot_encoder_resolution_rad", v.pivot_encoder_resolution_rad, 1.0, "an angle in radians");
  if (v.castors.size() < 2) demands.add("castor", std::to_string(v.castors.size()), "two castors or more");
  for (std::size_t i = 0; i < v.castors.size(); ++i) {
    const Castor& c = v.castors[i];
    Demands of_castor("castor[" + std::to_string(i + 1) + "].");
    const auto length = [&](const char* key, double value_m, double limit_m) {
      of_castor.above_zero(key, value_m, "a length in metres");
      of_castor.length_below(key, value_m, limit_m);
    };
    of_castor.zero_or_more("pivot_radius_m", c.pivot_radius_m, "a length in metres");
    of_castor.length_below("pivot_radius_m", c.pivot_radius_m, 50.0);
    of_castor.number("pivot_angle_rad", c.pivot_angle_rad, "an angle in radians");
    of_castor.within("offset_m", c.offset_m, 10.0, "a length in metres");
    length("wheel_radius_left_m", c.wheel_radius_left_m, 10.0);
    length("wheel_radius_right_m", c.wheel_radius_right_m, 10.0);
    length("wheel_offset_left_m", c.wheel_offset_left_m, 10.0);
    length("wheel_offset_right_m", c.wheel_offset_right_m, 10.0);
    of_castor.within("pivot_encoder_offset_rad", c.pivot_encoder_offset_rad, 7.0, "an angle in radians");
    for (std::size_t k = 0; k < i; ++k)
      if (odolab::length(v.castors[k].pivot() - c.pivot()) < 1e-3)
        of_castor.add("pivot_radius_m", "the place of castor " + std::to_string(k + 1), "a place of its own");
    demands.add(std::move(of_castor).problems());
  }
  return std::move(demands).problems();
}

MultiCastor three_castor_vehicle() {
  MultiCastor vehicle;
  for (int i = 0; i < 3; ++i) {
    Castor castor;
    castor.pivot_angle_rad = i * (2.0 * kPi / 3.0);
    vehicle.castors.push_back(castor);
  }
  return vehicle;
}

}  // namespace odolab
