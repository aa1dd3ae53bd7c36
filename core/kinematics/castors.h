// What the encoders of a multi-castor vehicle read where nothing slips: the body moves as told, the castors follow.
#pragma once

#include <vector>

#include "core/geometry/track.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/multi_castor.h"

namespace odolab {

// The body's velocity in its own frame, held for a time.
struct BodyTwist {
  double forward_mps = 0.0;
  double sideways_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double duration_s = 0.0;
};

class CastorKinematics {
 public:
  // `actual` is the machine itself. Its castors stand at the given true angles (none: all at 0), its wheels at 0.
  CastorKinematics(MultiCastor actual, const Pose& body, const std::vector<double>& castor_angles_rad = {});

  // Moves on by a twist, for its whole duration. The body's way is exact; the castors' angles are integrated by the
  // classical Runge-Kutta method in steps of at most 5 ms.
  void move(const BodyTwist& twist);

  const Pose& body() const { return body_; }
  double time_s() const { return time_s_; }
  // Unrounded, the pivot encoders' offsets included.
  CastorSample reading() const;
  // A wheel turns without the castor moving: spinning on ice, or climbing something.
  void add_idle_rotation(std::size_t castor, double left_rad, double right_rad);

 private:
  MultiCastor actual_;
  Pose body_;
  double time_s_ = 0.0;
  std::vector<double> angles_rad_;
  std::vector<WheelRotation> wheels_;
};

// The castor angles at which a vehicle rolls along a twist without swivelling on the way.
std::vector<double> trailing_angles(const MultiCastor& vehicle, const BodyTwist& twist);

// As the encoders report it: cut to whole steps, each encoder with a phase of its own drawn from the seed.
CastorSample rounded(const CastorSample& exact, const MultiCastor& vehicle, std::uint64_t seed);

}  // namespace odolab
