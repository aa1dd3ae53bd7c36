// Where two linked trucks believe to be: by truck A's dead reckoning, with IPEC or without.
#pragma once

#include <optional>

#include "core/odometry/ipec.h"

namespace odolab {

class LinkedBelief {
 public:
  LinkedBelief(const IpecTrucks& trucks, const Pose& truck_a, bool internal_correction)
      : trucks_(trucks), internal_correction_(internal_correction) {
    state_.a = truck_a;
  }

  // Once each sampling period, with readings from which the known offsets are taken off.
  void advance(const LinkedSample& now) {
    if (!last_) {
      state_ = ipec_start(now, state_.a);
    } else if (internal_correction_) {
      state_ = ipec_step(state_, *last_, now, trucks_);
    } else {
      state_ = ipec_start(now, dead_reckoned(state_.a, last_->a, now.a, trucks_.a));
    }
    last_ = now;
  }

  const Pose& truck_a() const { return state_.a; }
  // The point half a nominal length behind truck A's centre, heading along the link; continuous in its heading.
  Pose link_centre(double link_length_m) const {
    const Vec2 link = state_.a.position() - state_.b.position();
    const double heading_rad =
        last_ ? unwrapped(std::atan2(link.y_m, link.x_m), state_.a.heading_rad - wrapped(last_->link_angle_a_rad))
              : state_.a.heading_rad;
    return Pose{state_.a.x_m, state_.a.y_m, heading_rad} * Pose{-0.5 * link_length_m, 0.0, 0.0};
  }

 private:
  IpecTrucks trucks_;
  bool internal_correction_;
  IpecState state_;
  std::optional<LinkedSample> last_;
};

}  // namespace odolab
