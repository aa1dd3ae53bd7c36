#include "app/gui/first_scenario.h"

namespace odolab {

Scenario first_scenario() {
  Scenario s;
  s.name = "LabMate on its square";
  s.about =
      "A cable lies across the way of one wheel; the wheels and the wheelbase are not quite what the odometry "
      "believes.";
  s.actual.wheel_radius_left_m = 0.07494;
  s.actual.wheel_radius_right_m = 0.07506;
  s.actual.wheelbase_m = 0.3425;
  s.floor.roughness = {0.001, 0.02};
  Bump cable;
  cable.centre = {2.0, 0.45};
  cable.direction_rad = radians(100.0);
  cable.length_m = 0.8;
  s.floor.bumps.push_back(cable);
  return s;
}

}  // namespace odolab
