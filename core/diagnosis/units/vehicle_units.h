// A linked or castor vehicle as what it is made of: differential drives, the units, joined by what its other encoders
// read. Each truck, towing vehicle, trailer and castor is one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/vehicle_samples.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct VehicleUnit {
  std::string name;  // the contract's component: "truck_a", "trailer", "castor2"; empty: the vehicle that tows
  std::string key;   // its table in the vehicle file: "truck_a", "tow", "castor[2]"; empty: the kind's own
  DifferentialDrive drive;
  bool carries_truth = false;  // the tracked point sits on it
};

// Whether `diagnose` knows this kind by its units: all but a differential drive and a synchro drive.
bool has_units(const Vehicle& vehicle);

// Why a kind is not diagnosed; none where it is.
std::optional<Error> undiagnosed_kind(const Vehicle& vehicle);

// In the order of the recording's columns.
std::vector<VehicleUnit> units_of(const Vehicle& vehicle);
bool carries_truth(const std::vector<VehicleUnit>& units);  // one of them; else the joints say where each is
// The vehicle with another drive in the place of a unit's.
Vehicle with_drive(Vehicle vehicle, std::size_t unit, const DifferentialDrive& drive);
// A castor's axle so much further to the left of its pivot's line; other vehicles stay as they are.
void move_aside(Vehicle& vehicle, std::size_t unit, double by_m);
inline constexpr double kAsidePrior_m = 0.01;  // how far that is expected from the file at most

// What all encoders read at one time.
struct UnitSample {
  double time_s = 0.0;
  std::vector<WheelRotation> wheels;  // of each unit
  std::vector<double> joints;         // the others in the order of the columns: link angles and length, hitch, pivots
};
std::vector<UnitSample> unit_readings(const Recording& recording, const Vehicle& vehicle);
// Those in which time goes on: a stamp that repeats the one before tells no motion.
std::vector<UnitSample> unit_samples(const Recording& recording, const Vehicle& vehicle);

// Of one unit.
std::vector<WheelSample> wheels_of(const std::vector<UnitSample>& samples, std::size_t unit);
// Its way by its wheels alone, from the origin on; at the samples' times, and between those that come slowly.
Track way_of(const std::vector<UnitSample>& samples, std::size_t unit, const DifferentialDrive& drive);

// The step of each joint's encoder in the order of UnitSample::joints; 0: continuous.
std::vector<double> joint_steps(const Vehicle& vehicle);

// Linear between neighbours, or where these are further apart than 0.03 s a cubic; the ends hold beyond them.
std::vector<double> joints_at(const std::vector<UnitSample>& samples, double time_s);

// The middle of a unit's axle, looking along its rolling direction, as seen from the tracked point, where the joints
// read this and the vehicle's file is right.
Pose tracked_T_axle(const Vehicle& vehicle, std::size_t unit, const std::vector<double>& joints);

// By how much the rounding of the joints alone can move the axle that they tell: the whole step of each.
struct JointRounding {
  double position_m = 0.0, heading_rad = 0.0;
};
JointRounding rounding_of_joints(const Vehicle& vehicle, std::size_t unit);

// How far a link or drawbar holds two units apart; 0 where there is none.
double length_of_joint_m(const Vehicle& vehicle);

// A number of the vehicle's geometry that its units find out together.
struct JointParameter {
  std::string name, unit;               // the vehicle file's key
  double prior = 0.0;                   // how far from the file it is expected at most
  std::function<double&(Vehicle&)> of;  // where it stands
  std::string effect, component;        // the catalogue's words where it is a biased encoder; else empty
  double least = 0.0;                   // what matters in practice
  std::string parameter;                // "bias_rad"
};
std::vector<JointParameter> joint_parameters(const Vehicle& vehicle);

}  // namespace odolab
