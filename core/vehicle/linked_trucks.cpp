#include "core/vehicle/linked_trucks.h"

#include "core/vehicle/demands.h"

namespace odolab {

std::vector<std::string> problems_in(const LinkedTrucks& v) {
  Demands demands;
  demands.above_zero("link_length_m", v.link_length_m, "a length in metres");
  demands.length_below("link_length_m", v.link_length_m, 50.0);
  demands.above_zero("encoder_counts_per_revolution", v.truck_a.encoder_counts_per_revolution, "a number of counts");
  if (v.truck_a.encoder_counts_per_revolution != v.truck_b.encoder_counts_per_revolution)
    demands.add("encoder_counts_per_revolution", "different ones on the trucks", "the same");
  demands.zero_or_more("link_angle_resolution_rad", v.link_angle_resolution_rad, "an angle");
  demands.within("link_angle_resolution_rad", v.link_angle_resolution_rad, 1.0, "an angle in radians");
  demands.zero_or_more("link_length_resolution_m", v.link_length_resolution_m, "a length in metres");
  demands.length_below("link_length_resolution_m", v.link_length_resolution_m, 1.0);
  demands.within("link_angle_a_offset_rad", v.link_angle_a_offset_rad, 7.0, "an angle in radians");
  demands.within("link_angle_b_offset_rad", v.link_angle_b_offset_rad, 7.0, "an angle in radians");
  demands.within("link_length_offset_m", v.link_length_offset_m, 0.5 * v.link_length_m, "a length in metres");
  const auto lengths = [&](const char* name, const DifferentialDrive& truck) {
    Demands of_truck(std::string(name) + ".");
    of_truck.wheels(truck.wheel_radius_left_m, truck.wheel_radius_right_m, truck.wheelbase_m);
    demands.add(std::move(of_truck).problems());
  };
  lengths("truck_a", v.truck_a);
  lengths("truck_b", v.truck_b);
  return std::move(demands).problems();
}

}  // namespace odolab
