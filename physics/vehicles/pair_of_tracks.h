// Two tracks under a body in the planar world: each is a row of pads that hold the floor by Coulomb's law. When the
// body turns, the pads must skid sideways, and how far the tracks slip along with it comes out of the solve.
#pragma once

#include <array>
#include <vector>

#include "core/scenario/scenario.h"
#include "physics/ground.h"
#include "physics/planar_world.h"
#include "physics/vehicles/wheel_state.h"
#include "physics/wheel_drive.h"
#include "physics/wheel_pair.h"

namespace odolab {

class PairOfTracks {
 public:
  // `sprockets`: their radii, and the tracks' distance as the wheelbase. `carried` says mass and inertia. The body's
  // frame is its centre of mass's; the tracks' middle lies `tracks.centre_of_mass_x_m` behind it. The world must
  // outlive this, and had better solve friction exactly in every step.
  PairOfTracks(PlanarWorld& world, int body, const DifferentialDrive& sprockets, const ActualTracks& tracks,
               const ActualDrive& carried, const Motor& motor, double step_s);

  // In this order, once a step. Tracks bridge bumps and roughness: they meet slip zones and friction alone.
  void turn_motors(WheelPair set_speed_radps);
  void turn_exactly(WheelPair speed_radps);  // instead: the sprockets turn at these speeds
  void before_step(const Ground& ground, const Floor& floor);
  void after_step();

  // Sprockets; slip is the mean over a track's pads.
  const WheelState& left() const { return tracks_[0].state; }
  const WheelState& right() const { return tracks_[1].state; }

 private:
  struct Pad {
    Vec2 place;  // in the body's frame
    double load_n = 0.0;
    int tread = 0;
    double rolled_mps = 0.0;
  };
  struct Track {
    WheelDrive drive;
    Side side;
    double radius_m;
    std::vector<Pad> pads{};
    int motor = 0;             // in the world
    double speed_radps = 0.0;  // mean over the step
    WheelState state{};
  };

  PlanarWorld* world_;
  int body_;
  double step_s_;
  std::array<Track, 2> tracks_;
};

}  // namespace odolab
