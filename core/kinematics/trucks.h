// What the encoders of linked trucks and of trailers read where nothing slips.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/track.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/encoder_trailer.h"
#include "core/vehicle/linked_trucks.h"

namespace odolab {

// Motion of one truck, held for a time.
struct TruckTwist {
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

// Rotation of a truck's wheels over an exact arc.
WheelRotation wheel_rotation(const DifferentialDrive& truck, double travel_m, double turn_rad);

// Two trucks, each free to move as it is told: the link lengthens and turns as they do.
class LinkedKinematics {
 public:
  // `actual` is the machine itself. A stands at a pose; B follows from the link's length and angles.
  LinkedKinematics(LinkedTrucks actual, const Pose& a, double link_angle_a_rad, double link_angle_b_rad,
                   double link_length_m);

  void move(const TruckTwist& a, const TruckTwist& b, double duration_s);

  const Pose& a() const { return a_; }
  const Pose& b() const { return b_; }
  double time_s() const { return reading_.time_s; }
  double link_heading_rad() const;  // the direction from B to A
  double link_length_m() const;
  // Unrounded, the encoders' offsets included.
  LinkedSample reading() const;
  // Wheels turn further than the trucks travel: over a bump.
  void add_idle_rotation(const WheelRotation& a, const WheelRotation& b);

 private:
  LinkedTrucks actual_;
  Pose a_, b_;
  LinkedSample reading_;  // wheels and time
};

// As the encoders report it: whole counts and steps, each encoder with a phase of its own drawn from the seed.
LinkedSample rounded(const LinkedSample& exact, const LinkedTrucks& vehicle, std::uint64_t seed);

// A towing vehicle that moves as it is told and a trailer that is drawn, or pushed, along; it swivels freely.
class TrailerKinematics {
 public:
  TrailerKinematics(EncoderTrailer actual, const Pose& tow, double hitch_angle_rad);

  // The tow's way is exact; the hitch angle is integrated by the classical Runge-Kutta method, steps of a millisecond.
  void move(const TruckTwist& tow, double duration_s);

  const Pose& tow() const { return tow_; }
  double time_s() const { return reading_.time_s; }
  double hitch_angle_rad() const { return hitch_angle_rad_; }
  TrailerSample reading() const;  // unrounded, the encoder's offset included
  void add_idle_rotation(const WheelRotation& tow, const WheelRotation& trailer);

 private:
  EncoderTrailer actual_;
  Pose tow_;
  double hitch_angle_rad_ = 0.0;
  TrailerSample reading_;  // wheels and time
};

TrailerSample rounded(const TrailerSample& exact, const EncoderTrailer& vehicle, std::uint64_t seed);

}  // namespace odolab
