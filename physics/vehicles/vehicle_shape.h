// What a vehicle of any kind looks like from above: plain bodies, wheels and joints for those who draw it, and what its
// joints read. The shape stays; the posture is that of one moment.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/vehicle/differential_drive.h"
#include "physics/vehicles/wheel_state.h"

namespace odolab {

// A body in a frame of its own. Vehicle files know no hulls: outlines are drawn round the wheels, which are to scale.
struct BodyShape {
  std::vector<Vec2> outline;  // convex; empty: nothing but its wheels and rods
  bool see_through = false;   // lies above other bodies
};

// A wheel, or where its contact has a length the track round it.
struct WheelShape {
  std::string name;  // "left", "A right", "castor 2 left"
  int body = 0;
  Vec2 place;                  // in the body's frame
  double direction_rad = 0.0;  // in which it rolls while it is not steered
  double radius_m = 0.0;       // true
  double width_m = 0.0;        // an assumption
  double contact_length_m = 0.0;
};

std::string words_of(const WheelShape& wheel);  // "A right wheel", "left track"

// A straight part between a point of one body and a point of another, or of the same.
struct RodShape {
  int from_body = 0, to_body = 0;
  Vec2 from, to;
  bool springs = false;  // its length gives way
};

struct JointShape {
  int body = 0;
  Vec2 place;
};

struct FreeCastorShape {
  int body = 0;
  Vec2 place;
  double radius_m = 0.0;
};

// Something that an encoder measures between bodies, or that would be good to know.
struct GaugeShape {
  std::string name;     // "link angle A"
  std::string channel;  // of the recording; empty where no encoder reads it
  bool is_length = false;
};

struct VehicleShape {
  std::vector<BodyShape> bodies;
  std::vector<WheelShape> wheels;
  std::vector<RodShape> rods;
  std::vector<JointShape> joints;
  std::vector<FreeCastorShape> free_castors;
  std::vector<GaugeShape> gauges;
};

// Of the same instant.
struct GaugeReading {
  double truth = 0.0;     // rad or m
  double measured = 0.0;  // as the encoder reads it; not a number where none does
};

// One entry for each of the shape's.
struct VehiclePosture {
  Pose reference;  // true pose of the point that the truth measures
  std::vector<Pose> bodies;
  std::vector<WheelState> wheels;
  std::vector<GaugeReading> gauges;
};

// Between two moments of one vehicle, `share` of the way from the first; what does not flow is the nearer one's.
VehiclePosture between(const VehiclePosture& first, const VehiclePosture& second, double share);

// Parts that kinds share. Each adds to the shape a body with what belongs to it, and returns its number. `name` is put
// before the names of its wheels.

// The base of a differential drive about its axle's centre, with toes of its wheels.
int add_drive_shape(VehicleShape& shape, const DifferentialDrive& wheels, const std::string& name,
                    double toe_left_rad = 0.0, double toe_right_rad = 0.0);
// A trailer about its axle's centre, its drawbar reaching so far ahead.
int add_trailer_shape(VehicleShape& shape, const DifferentialDrive& wheels, double drawbar_length_m,
                      const std::string& name);
// A hull between two tracks, whose middle lies at x = `middle_x_m`; `sprockets` has the tracks' distance as wheelbase.
int add_tracked_shape(VehicleShape& shape, const DifferentialDrive& sprockets, double contact_length_m,
                      double middle_x_m);

// Corners of a circle about the origin.
std::vector<Vec2> round_outline(double radius_m);

}  // namespace odolab
