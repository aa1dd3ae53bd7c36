// What is to be simulated, as plain data: a vehicle, how it differs from its drawing, a floor, a path and sensors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnosis/active_effect.h"
#include "core/scenario/actual_machine.h"
#include "core/scenario/floor.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// The machine itself, of which its odometry knows nothing. The lengths replace the nominal ones. Of vehicles other than
// a differential drive the lengths stand in ActualMachine, and these are the toe and weight of the base or of each
// truck.
struct ActualDrive {
  double wheel_radius_left_m = 0.075;
  double wheel_radius_right_m = 0.075;
  double wheelbase_m = 0.340;
  double toe_left_rad = 0.0;  // misalignment: the wheel's rolling direction against straight ahead
  double toe_right_rad = 0.0;
  double mass_kg = 50.0;
  double moment_of_inertia_kgm2 = 3.0;  // about the vertical axis through the axle's centre
  double drive_wheel_load_share = 0.7;  // of the weight; the castors carry the rest
};

// Speed-controlled motor of each drive wheel.
struct Motor {
  bool ideal = false;                // true: the wheel turns exactly as told
  double wheel_inertia_kgm2 = 0.02;  // wheel, gear and rotor, seen at the wheel
  double torque_limit_nm = 8.0;
  double proportional_gain = 4.0;  // N m per rad/s
  double integral_gain = 40.0;     // N m per rad
};

struct Sensors {
  double encoder_period_s = 0.020;       // the encoders are read, and odometry and the driver run, this often
  double truth_period_s = 0.010;         // 0: only at the start and the end of the run, as with a sonar corner
  double truth_position_noise_m = 0.0;   // standard deviation
  double truth_heading_noise_rad = 0.0;  // standard deviation
  bool truth_heading = true;             // false: the truth knows the position alone
  bool record_encoders = true;           // false: the recording has no wheels, though the robot drives by them
  bool record_commands = false;          // true: the recording has what the driver asked of the base
};

// How fast the driver goes.
struct Driving {
  double speed_mps = 0.2;
  double turn_rate_radps = 1.0;
  double acceleration_mps2 = 0.2;
  double turn_acceleration_radps2 = 1.0;
  double stands_s = 0.0;  // before it sets off, and again at the end of its way; not by hand, nor when it replays
  // Vehicles that can correct their odometry from the inside (IPEC, CAST) steer by it; false: by plain dead reckoning.
  bool internal_correction = true;
  bool by_eye = false;  // a person with a joystick who sees where the vehicle really is; else by its own odometry
};

// Closed square with a stop and a turn on the spot at each corner, a fourth turn at the end (UMBmark report, section
// 3).
struct SquarePath {
  double side_m = 4.0;
  bool clockwise = false;
};
struct StraightPath {
  double length_m = 4.0;
  bool there_and_back = false;  // the way back in reverse
};
struct FigureEightPath {
  double radius_m = 1.0;
  int loops = 1;
};
// Round a rectangle without a stop, each corner an arc; it starts and ends where the last arc touches the first side.
struct RectanglePath {
  double length_m = 7.0;  // along the start's heading
  double width_m = 4.0;
  double corner_radius_m = 0.45;
  bool clockwise = false;
};
// One after the other: a straight shift without turning, then a turn on the spot. Sideways for vehicles that can.
struct Manoeuvre {
  double forward_m = 0.0;
  double left_m = 0.0;
  double turn_rad = 0.0;
};
struct ManoeuvrePath {
  std::vector<Manoeuvre> moves;
};
// Straight lines between points, a turn on the spot at each.
struct WaypointPath {
  std::vector<Vec2> points;
};
// Wheel speeds, each reached by a linear ramp over its own duration's first `ramp_s` and then held.
struct WheelSpeeds {
  double duration_s = 1.0;
  double left_radps = 0.0;
  double right_radps = 0.0;
};
struct WheelSpeedPath {
  std::vector<WheelSpeeds> phases;
  double ramp_s = 0.5;
};
// Driven by a person: the window's keys, or nothing.
struct HandPath {
  double duration_s = 60.0;
};
// The wheels turn, or the commands are given, as in a recording.
struct ReplayPath {
  std::string recording;  // file, relative to the scenario's
  enum class By { wheels, commands } by = By::wheels;
};

using Path = std::variant<SquarePath, StraightPath, FigureEightPath, WaypointPath, WheelSpeedPath, HandPath,
                          RectanglePath, ManoeuvrePath, ReplayPath>;

// UMBmark: the square path driven several times in each direction.
struct Benchmark {
  int runs_each_way = 5;
  bool extended = false;  // with the floor's bumps: Eqs. 3.5 and 3.6 against the same robot without them
};

// A figure of the run's summary that must lie in a range; `odolab run --check` judges it.
struct Expectation {
  std::string figure;  // a key of summary.json, e.g. "end_position_error_m"
  std::optional<double> at_least;
  std::optional<double> at_most;
};

struct Scenario {
  std::string name = "LabMate on its square";
  std::string about;         // a sentence or two for the person who opens it
  Vehicle vehicle;           // nominal: what odometry believes
  std::string vehicle_file;  // where it came from, relative to the scenario's file; may be empty
  ActualDrive actual;
  ActualMachine machine;  // what else there is of vehicles other than a differential drive
  Motor motor;
  Floor floor;
  std::vector<ActiveEffect>
      effects;  // physics beyond the plain machine; core/scenario/effect_catalogue.h has the words
  Pose start;
  Driving driving;
  Path path = SquarePath{};
  Sensors sensors;
  std::optional<Benchmark> benchmark;
  std::vector<Expectation> expectations;
  double step_s = 0.001;
  std::uint64_t seed = 1;
};

// All that is wrong with a scenario, each a sentence that starts with the key.
std::vector<std::string> problems_in(const Scenario& scenario);

// The actual drive of a machine that is just as its drawing says. A drawing knows no weight: mass and inertia are those
// of a LabMate scaled to the wheelbase, as bodies of one shape and density are.
ActualDrive as_drawn(const DifferentialDrive& nominal);

}  // namespace odolab
