// A vehicle in the planar world as the simulation sees it, whatever its kind.
//
// A kind is one file in this folder, which defines the function that makes it, and one line in planar_vehicle.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "physics/driver/base_command.h"
#include "physics/effects/effects.h"
#include "physics/ground.h"
#include "physics/vehicles/vehicle_shape.h"
#include "physics/vehicles/wheel_state.h"
#include "physics/wheel_pair.h"

namespace odolab {

// What a vehicle is built from. The effects must outlive it.
struct VehicleSetup {
  const Scenario& scenario;
  Pose start;  // of the point whose pose the truth measures
  const planar::Effects& effects;
  std::uint64_t sensor_seed = 0;
  // The readings with which a recording that is replayed begins, in the order of the vehicle's channels: how links,
  // hitches and pivots stand. Empty: a straight train, pivots at zero.
  std::vector<double> first_readings = {};
};

// The base commands before and after a step, which set speeds follow evenly: a jump would make the wheels slip.
struct CommandRamp {
  BaseCommand before, next;
  double share = 1.0;  // of the way from one to the other, in the middle of the step
};

// A vehicle with one pair of drive wheels, which can be driven by their speeds as well.
class DrivenByWheels {
 public:
  virtual ~DrivenByWheels() = default;
  // One step on this ground with the motors set to these speeds, in rad/s.
  virtual void drive_wheels(const Ground& ground, const Floor& floor, WheelPair set_speed_radps) = 0;
  // The motion that such wheels give the nominal vehicle.
  virtual BaseCommand motion_of(WheelPair speed_radps) const = 0;
};

class PlanarVehicle {
 public:
  virtual ~PlanarVehicle() = default;

  // One step on this ground.
  virtual void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) = 0;
  // A push from outside at the centre of mass of the first body, spread over the next step.
  virtual void push(Vec2 impulse_ns) = 0;
  // The clock of the run at its start, for effects that have a time; 0 if not told.
  virtual void set_clock(double begin_s) = 0;
  // Of a recording that is replayed, the columns that turn the vehicle's motors, a speed for each; and one step in
  // which their encoders are to count exactly these speeds.
  virtual std::vector<std::string> turned_channels() const = 0;
  virtual void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds_radps) = 0;
  // The motors turn at these speeds from now on, and the vehicle moves with them.
  virtual void begin_in_motion(const std::vector<double>& speeds_radps) = 0;
  // Null where the vehicle has no such pair of wheels.
  virtual DrivenByWheels* by_wheels() { return nullptr; }

  // True motion of the point whose pose the truth measures.
  virtual Pose pose() const = 0;
  virtual double speed_mps() const = 0;  // forward
  virtual double yaw_rate_radps() const = 0;
  // The drive wheels of the first body, for those who watch.
  virtual WheelState left() const = 0;
  virtual WheelState right() const = 0;
  // Where the other bodies stand on the floor: none, or always the same ones in the same order.
  virtual void place_other_bodies(std::vector<Pose>& /*poses*/) const {}

  // What it looks like, and how it stands at this moment: bodies, wheels and the truth of its gauges.
  virtual VehicleShape shape() const = 0;
  virtual void pose_parts(VehiclePosture& posture) const = 0;

  // The recording's columns that its sensors fill (contract's names), and one sample of them in that order. Sampling
  // also advances the vehicle's own dead reckoning, which starts at the first sample.
  virtual std::vector<std::string> channels() const = 0;
  virtual void sample(double time_s, std::vector<double>& readings) = 0;
  // Where the vehicle believes to be: the point that the truth measures, and the one that the driver steers.
  virtual Pose believed() const = 0;
  virtual Pose believed_driven_point() const { return believed(); }
};

// The vehicle of the scenario, by the kind of its nominal vehicle. The scenario has no problems (problems_in).
std::unique_ptr<PlanarVehicle> make_planar_vehicle(const VehicleSetup& setup);

}  // namespace odolab
