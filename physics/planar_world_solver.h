// What a planar world is made of inside: Box2D's bodies beside their poses in double. For planar_world*.cpp alone.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "physics/coulomb_solve.h"
#include "physics/planar_world.h"

class b2Body;
class b2FrictionJoint;
class b2WheelJoint;
class b2World;

namespace odolab {

namespace planar_world {

inline Vec2 turned(Vec2 v, double c, double s) { return {c * v.x_m - s * v.y_m, s * v.x_m + c * v.y_m}; }

}  // namespace planar_world

struct PlanarWorld::Solver {
  struct Body {
    Pose pose;
    Vec2 velocity_mps;
    double yaw_rate_radps = 0.0;
    Vec2 force_n;
    double torque_nm = 0.0;
    double mass_kg = 1.0;
    double inertia_kgm2 = 1.0;
    b2Body* solved = nullptr;
    // Change of the velocities in the last step by what acts within the world: floor, springs, joints.
    Vec2 inner_mps;
    double inner_radps = 0.0;
    // In the frame of the solution, during a step:
    Vec2 place;
    double cos_turn = 1.0, sin_turn = 0.0;
    double turn_rad = 0.0;
    double middle_rad = 0.0;  // heading on the floor in the middle of the step, as it came out
    // On the floor, during a step: velocities with the forces from outside alone, then with all; the heading that these
    // were solved at.
    Vec2 pushed_mps, next_mps;
    double pushed_radps = 0.0, next_radps = 0.0, solved_at_rad = 0.0;
  };

  // A damped spring along the line between two points, or along a line fixed to body a.
  struct Spring {
    int a = 0, b = 1;
    Vec2 anchor_a, anchor_b;
    bool along_line = false;
    double direction_rad = 0.0;
    double rest_length_m = 0.0;
    double stiffness_npm = 0.0, damping_nspm = 0.0;
  };

  // A rigid joint in double: where it is to be put right after each step.
  struct Rigid {
    int a = 0, b = 1;
    Vec2 anchor_a, anchor_b;
    bool along_line = false;
    double direction_rad = 0.0;
  };

  struct FreeWheel {
    int body = 0;
    Vec2 place;
    double direction_rad = 0.0;
    b2Body* floor = nullptr;
    b2WheelJoint* joint = nullptr;
  };

  struct Tread {
    int body = 0;
    Vec2 place;
    Vec2 velocity_mps;
    double grip_n = 0.0;
    int drive = -1;
    Vec2 drive_direction;
    Vec2 force_n;  // in the body's frame
    b2Body* floor = nullptr;
    b2FrictionJoint* joint = nullptr;
  };

  Solver(double step, Friction friction);
  ~Solver();

  double step_s;
  Friction exact;
  bool slides = false;  // in the last step
  bool solved_exactly = false;
  std::unique_ptr<b2World> world;
  std::vector<Body> bodies;
  std::vector<Tread> treads;
  std::vector<CoulombDrive> drives;
  std::vector<FreeWheel> free_wheels;
  std::vector<Rigid> rigid_joints;
  std::vector<Spring> springs;

  // Moves two bodies, each the less the heavier it is, so that point b of body b comes to lie on point a of body a, or
  // on the line through it. Linear in the small gap (README, Eq. 7).
  void close_gap(const Rigid& joint);
  // Of the two bodies' reduced mass.
  void add_spring(Spring spring, double frequency_hz, double damping_ratio);

  // next_mps, next_radps from pushed_mps, pushed_radps (README, Eqs. 1 to 3).
  void solve_with_box2d();
  // The forces of the step as Box2D found them.
  void take_forces();
  // Whether some wheel pulled with all its grip in the step that Box2D has just solved.
  bool any_wheel_slides() const;
  // Solves the step, or solves it again, with exact friction (README, Eqs. 8 and 12): next_mps, next_radps and all
  // forces.
  void solve_sliding();
  CoulombSolve sliding;
};

}  // namespace odolab
