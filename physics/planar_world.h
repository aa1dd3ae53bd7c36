// Rigid bodies in the plane that stand on wheels, solved by Box2D but kept in double precision.
//
// Wheels are moving treads inside the solver, and every step is solved in a frame that moves along with the first body,
// so that single precision sees small deviations only. README.md in this folder has the equations and what they reach.
#pragma once

#include <memory>
#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

struct BodyDefinition {
  Pose pose;  // of the centre of mass on the floor
  double mass_kg = 50.0;
  double moment_of_inertia_kgm2 = 3.0;
};

// A spring between two bodies (a damped distance constraint).
struct SpringDefinition {
  int body_a = 0;
  int body_b = 1;
  Vec2 anchor_a, anchor_b;  // in the frame of each body
  double rest_length_m = 1.0;
  double frequency_hz = 2.0;
  double damping_ratio = 0.7;
};

// Two bodies that share a point and turn freely about it.
struct PinDefinition {
  int body_a = 0;
  int body_b = 1;
  Vec2 anchor_a, anchor_b;  // the point in the frame of each body
};

// A point of body b that slides freely or against a damped spring along a line fixed to body a, and turns freely.
struct SliderDefinition {
  int body_a = 0;
  int body_b = 1;
  Vec2 anchor_a, anchor_b;     // in the frame of each body; the spring rests where they meet
  double direction_rad = 0.0;  // of the line in a's frame
  double frequency_hz = 0.0;   // 0: slides freely
  double damping_ratio = 0.7;
};

// How steps are solved. Box2D does those in which every wheel holds, and where one slides, the step is solved again
// with exact friction in double; where contacts slide in nearly every step (tracks), Box2D is not asked.
enum class Friction { where_it_slides, in_every_step };

class PlanarWorld {
 public:
  explicit PlanarWorld(double step_s, Friction exact = Friction::where_it_slides);
  ~PlanarWorld();
  PlanarWorld(PlanarWorld&&) noexcept;
  PlanarWorld& operator=(PlanarWorld&&) noexcept;

  // Bodies and treads are named by the numbers that come back. Body 0 carries the frame of the solution.
  int add_body(const BodyDefinition& definition);
  int add_tread(int body, Vec2 place);  // where a wheel touches the floor, in the body's frame
  void add_spring(const SpringDefinition& definition);
  // Rigid: the solver sees to their velocities, and after each step their positions are put right in double.
  void add_pin(const PinDefinition& definition);
  void add_slider(const SliderDefinition& definition);
  // A wheel that rolls freely along a direction of the body's frame and does not move sideways, whatever the force.
  int add_free_wheel(int body, Vec2 place, double direction_rad = 0.0);

  // What the tread does in the next step: the velocity over the floor that the wheel would give the body's point above
  // it if it did not slip (in the body's frame), and the force at which it starts to slip.
  void set_tread(int tread, Vec2 velocity_mps, double grip_n);
  // A motor that feels the floor through the treads of one body. In a step that is solved with exact friction the
  // velocities just set for them change by what the motor adds, times a direction of each (in the body's frame):
  // `free_change_mps` without the floor's forces, to which it yields by this inertia. What came of it is told
  // afterwards; 0 where all wheels held and Box2D solved.
  int add_drive(int body);
  void set_drive(int drive, double inertia_kg, double free_change_mps);  // holds for the next step
  void set_tread_drive(int tread, int drive, Vec2 direction);            // likewise, after set_tread
  double drive_change_mps(int drive) const;
  bool solved_exactly() const;  // the last step
  // Below this slip exact friction is softer than Coulomb's law (1 nm/s if not said). Wheels that quarrel rigidly
  // without slipping have no one solution, and a model of their creep that looks at their forces wants one.
  void soften_friction(double slip_mps);
  // Sets a body in motion, as at the start of a run that begins while it moves.
  void set_velocity(int body, Vec2 velocity_mps, double yaw_rate_radps);
  // Acts during the next step alone; in the floor's frame, at the centre of mass.
  void apply_force(int body, Vec2 force_n, double torque_nm = 0.0);

  void step();

  const Pose& pose(int body) const;
  Vec2 velocity_mps(int body) const;  // in the floor's frame
  double yaw_rate_radps(int body) const;
  // Force of the floor on the body through this tread, mean over the last step, in the body's frame.
  Vec2 tread_force_n(int tread) const;
  // The point's velocity over the floor, turned into the body's frame at the middle of the last step.
  Vec2 velocity_of_point_mps(int body, Vec2 place) const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace odolab
