// A wheel whose tread yields before it slips, so that the vehicle swings behind it (forms.h, TractionForm).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

// The same to what is fitted and to what the planar world plays.
class YieldingTread {
 public:
  // By how much the vehicle stays behind while the wheel rolls a way and speeds up by so much, of a form that gives way
  // and yields; for one per m/s2 of slip. Not by its way alone: what shakes a wheel between two readings is their
  // noise, of which a filter of its speed would make the vehicle's inertia.
  double stays_behind_m(double way_m, double acceleration_mps2, double duration_s, double radius_m,
                        const TractionForm& form) {
    constexpr double kDamped = 0.3;  // of what is critical
    constexpr double kPiece_s = 0.005;
    if (!(duration_s > 0.0)) return 0.0;
    const double k = *form.gives_way_s_per_mps, relaxes_m = form.yields_radii * radius_m, swings_s2 = k * relaxes_m,
                 damps_s = 2.0 * kDamped * std::sqrt(swings_s2), rolls_mps = std::abs(way_m) / duration_s;
    const int pieces = std::max(1, static_cast<int>(std::ceil(duration_s / kPiece_s)));
    const double dt = duration_s / pieces;
    double lost_m = 0.0;
    for (int piece = 0; piece < pieces; ++piece) {  // by the ends of the pieces: stable however long these are
      const double keeps = 1.0 / (1.0 + dt * rolls_mps / relaxes_m), pulls = dt * (keeps * dt + damps_s) / swings_s2;
      slips_mps_ = (slips_mps_ + dt * (acceleration_mps2 - keeps * deflected_m_ / swings_s2)) / (1.0 + pulls);
      deflected_m_ = keeps * (deflected_m_ + dt * slips_mps_);
      lost_m += dt * slips_mps_;
    }
    return lost_m / k;
  }

 private:
  double slips_mps_ = 0.0, deflected_m_ = 0.0;
};

}  // namespace odolab::effects
