// Keeps two trucks on a compliant link together while the link's centre moves as commanded.
#pragma once

#include "physics/driver/base_command.h"

namespace odolab {

// What each truck is told: speed and turn rate of its own.
struct TruckCommands {
  BaseCommand a, b;
};

// What the controller sees, by the vehicle's own encoders.
struct LinkReadings {
  double angle_a_rad = 0.0;
  double angle_b_rad = 0.0;
  double length_m = 1.0;
};

// The rigid motion of the link gives the velocity of each truck's centre; a truck is steered into the direction of its
// own by its link angle, forward or backward, whichever is nearer, and the whole waits while a truck is far from it.
// The link's length is held by the trucks' speeds along it. J. Borenstein, "Control and kinematic design of
// multi-degree-of-freedom mobile robots with compliant linkage", 1995, has the idea; gains are ours.
class LinkedTrucksControl {
 public:
  LinkedTrucksControl(double link_length_m, double period_s) : link_length_m_(link_length_m), period_s_(period_s) {}

  // Once each sampling period. The command is for the link's centre, in the link's frame (x from B to A).
  TruckCommands update(const BaseCommand& command, const LinkReadings& readings);

 private:
  struct Steered {
    double direction_rad = 0.0;  // of travel against the link, after the choice of forward or backward
    double sign = 1.0;           // -1: backward
    double turning_radps = 0.0;  // of the direction
  };
  void choose_direction(Steered& truck, double along_mps, double across_mps, double angle_rad) const;

  double link_length_m_;
  double period_s_;
  double pace_ = 1.0;  // share of the command that is driven
  Steered a_, b_;
};

}  // namespace odolab
