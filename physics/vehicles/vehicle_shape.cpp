#include "physics/vehicles/vehicle_shape.h"

#include <algorithm>

namespace odolab {

namespace {

// Tyres as wide as a LabMate's look in its pictures, and never so wide that two meet.
double tyre_width_m(double radius_m, double track_m) { return std::min(0.72 * radius_m, 0.25 * track_m); }

void add_wheel_pair(VehicleShape& shape, int body, const DifferentialDrive& wheels, const std::string& name,
                    double toe_left_rad, double toe_right_rad) {
  const double half_m = 0.5 * wheels.wheelbase_m;
  const auto width_m = [&](double radius_m) { return tyre_width_m(radius_m, wheels.wheelbase_m); };
  const double left_m = wheels.wheel_radius_left_m, right_m = wheels.wheel_radius_right_m;
  shape.wheels.push_back({name + "left", body, {0.0, half_m}, toe_left_rad, left_m, width_m(left_m), 0.0});
  shape.wheels.push_back({name + "right", body, {0.0, -half_m}, toe_right_rad, right_m, width_m(right_m), 0.0});
}

double mixed(double a, double b, double u) { return a + u * (b - a); }

}  // namespace

VehiclePosture between(const VehiclePosture& first, const VehiclePosture& second, double share) {
  VehiclePosture out = share < 0.5 ? first : second;
  const auto pose = [&](const Pose& a, const Pose& b) {
    return Pose{mixed(a.x_m, b.x_m, share), mixed(a.y_m, b.y_m, share), mixed(a.heading_rad, b.heading_rad, share)};
  };
  out.reference = pose(first.reference, second.reference);
  for (std::size_t i = 0; i < out.bodies.size(); ++i) out.bodies[i] = pose(first.bodies[i], second.bodies[i]);
  for (std::size_t i = 0; i < out.wheels.size(); ++i) {
    const WheelState &a = first.wheels[i], &b = second.wheels[i];
    out.wheels[i].rotation_rad = mixed(a.rotation_rad, b.rotation_rad, share);
    out.wheels[i].steered_rad = mixed(a.steered_rad, b.steered_rad, share);
  }
  return out;
}

std::string words_of(const WheelShape& wheel) {
  return wheel.name + (wheel.contact_length_m > 0.0 ? " track" : " wheel");
}

std::vector<Vec2> round_outline(double radius_m) {
  constexpr int kCorners = 36;
  std::vector<Vec2> outline;
  for (int i = 0; i < kCorners; ++i) outline.push_back(rotated({radius_m, 0.0}, 2.0 * kPi * i / kCorners));
  return outline;
}

int add_drive_shape(VehicleShape& shape, const DifferentialDrive& wheels, const std::string& name, double toe_left_rad,
                    double toe_right_rad) {
  const int body = int(shape.bodies.size());
  const double w = wheels.wheelbase_m;
  const double tyre_m = tyre_width_m(std::max(wheels.wheel_radius_left_m, wheels.wheel_radius_right_m), w);
  const double back = -0.85 * w, front = 0.85 * w, side = 0.5 * w + tyre_m;
  // The front's corners are cut, so that it is told from the back at any size.
  shape.bodies.push_back({{{back, -side},
                           {0.55 * front, -side},
                           {front, -0.55 * side},
                           {front, 0.55 * side},
                           {0.55 * front, side},
                           {back, side}},
                          false});
  for (const double x : {back + 0.12 * w, front - 0.22 * w}) shape.free_castors.push_back({body, {x, 0.0}, 0.06 * w});
  add_wheel_pair(shape, body, wheels, name, toe_left_rad, toe_right_rad);
  return body;
}

int add_trailer_shape(VehicleShape& shape, const DifferentialDrive& wheels, double drawbar_length_m,
                      const std::string& name) {
  const int body = int(shape.bodies.size());
  const double half_m = 0.5 * wheels.wheelbase_m, radius_m = wheels.wheel_radius_left_m;
  const double side = half_m - 0.6 * tyre_width_m(radius_m, wheels.wheelbase_m), end = 0.9 * radius_m;
  shape.bodies.push_back({{{-end, -side}, {end, -side}, {end, side}, {-end, side}}, false});
  shape.rods.push_back({body, body, {0.0, 0.0}, {drawbar_length_m, 0.0}, false});
  shape.joints.push_back({body, {drawbar_length_m, 0.0}});
  add_wheel_pair(shape, body, wheels, name, 0.0, 0.0);
  return body;
}

int add_tracked_shape(VehicleShape& shape, const DifferentialDrive& sprockets, double contact_length_m,
                      double middle_x_m) {
  const int body = int(shape.bodies.size());
  const double half_m = 0.5 * sprockets.wheelbase_m, width_m = 0.25 * sprockets.wheelbase_m;
  const double end = 0.5 * contact_length_m + 0.4 * sprockets.wheel_radius_left_m, side = half_m;
  shape.bodies.push_back({{{middle_x_m - end, -side},
                           {middle_x_m + 0.6 * end, -side},
                           {middle_x_m + end, -0.6 * side},
                           {middle_x_m + end, 0.6 * side},
                           {middle_x_m + 0.6 * end, side},
                           {middle_x_m - end, side}},
                          false});
  const double left_m = sprockets.wheel_radius_left_m, right_m = sprockets.wheel_radius_right_m;
  shape.wheels.push_back({"left", body, {middle_x_m, half_m}, 0.0, left_m, width_m, contact_length_m});
  shape.wheels.push_back({"right", body, {middle_x_m, -half_m}, 0.0, right_m, width_m, contact_length_m});
  return body;
}

}  // namespace odolab
