// One step of bodies whose wheels slide: stick and slip by Coulomb's law, springs and rigid joints in one solve, in
// double precision.
//
// Box2D gives a contact the force that would stop it, cut to its grip, so that the force of one that slides leans from
// the direction of its slip by the body's unequal inertia about it: README, "Contacts that slide" and Eq. 8.
#pragma once

#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

// All directions and arms are on the floor's axes; an arm reaches from the body's centre of mass.
struct CoulombBody {
  double mass_kg = 1.0;
  double inertia_kgm2 = 1.0;
  Vec2 velocity_mps;  // before: without the forces that are solved for; afterwards with them
  double yaw_rate_radps = 0.0;
  Vec2 guess_mps;  // where the search for them begins
  double guess_radps = 0.0;
};

struct CoulombContact {
  int body = 0;
  Vec2 arm;
  Vec2 surface_mps;      // the body's point would move so if it did not slip
  double grip_ns = 0.0;  // the largest impulse of the step
  // To `surface_mps` comes what a drive adds, times this direction.
  int drive = -1;  // -1: the surface moves as given
  Vec2 direction;
  Vec2 impulse_ns;  // comes out: of the floor on the body
};

// A motor that feels the floor through the contacts of one body that it drives.
struct CoulombDrive {
  int body = 0;
  double inertia_kg = 1.0;  // by which it yields to the floor
  double free_mps = 0.0;    // what it would add without the floor
  double added_mps = 0.0;   // comes out
};

// Something that resists the speed u at which point b leaves point a along a direction: impulse on b
// -(resistance_kg u + bias_ns), against it on a. A damped spring, or, with `rigid_kg`, a joint.
struct CoulombLink {
  int body_a = -1;  // -1: the floor
  int body_b = 0;
  Vec2 direction;
  Vec2 arm_a, arm_b;
  double resistance_kg = 0.0;
  double bias_ns = 0.0;
  double impulse_ns = 0.0;  // comes out: on b

  static constexpr double rigid_kg = 1e9;  // an impulse of 1 Ns opens it at 1 nm/s
};

// Finds the velocities at which half M (v - v_before)^2 + sum grip |slip| + the links' energy is least. It is convex.
class CoulombSolve {
 public:
  std::vector<CoulombBody> bodies;
  std::vector<CoulombContact> contacts;
  std::vector<CoulombDrive> drives;
  std::vector<CoulombLink> links;

  // Below this slip the law is softer than Coulomb's: a contact that holds half its grip creeps at 0.6 of it.
  double softness_mps = 1e-9;

  void solve();

 private:
  // A drive's row of the curvature: with itself, and with the three numbers of its body.
  struct DriveRow {
    double gradient = 0.0, curvature = 0.0;
    double with_body[3] = {};
  };
  Vec2 slip_mps(const std::vector<double>& v, const CoulombContact& contact) const;
  double cost(const std::vector<double>& v, double soft_mps) const;
  void newton_step(const std::vector<double>& v, double soft_mps);
  bool settle(double soft_mps);
  void take_pulls(double share, double soft_mps);

  std::vector<DriveRow> drive_rows_;
  std::vector<Vec2> pulls_;  // of each contact, as a share of its grip
  std::vector<double> before_, now_, next_, step_, hessian_;
};

}  // namespace odolab
