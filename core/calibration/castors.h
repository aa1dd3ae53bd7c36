// Geometric calibration of a multi-castor vehicle from its own encoders: J. Doebbler, J. J. Davis, J. L. Junkins, J.
// Valasek, "Odometry and Calibration Methods for Multi-Castor Vehicles", 2008, section III.A, Eqs. 1 to 9.
//
// One castor is held still; the others drive the vehicle about its pivot, clockwise and counter-clockwise. The distance
// between two pivots is known; the two axles of a castor are in line.
#pragma once

#include <vector>

#include "core/calibration/internal.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/multi_castor.h"

namespace odolab {

// What one castor's encoders read while the vehicle turned about another's pivot.
struct CastorOnCircle {
  double pivot_rad = 0.0;  // gamma: the pivot's reading once the castor had settled
  double left_rad = 0.0;   // c: rotation of the wheels, magnitudes
  double right_rad = 0.0;
};

// One run about a still castor.
struct Revolution {
  std::size_t still = 0;  // which castor was held, counted from 0
  bool clockwise = false;
  double turn_rad = 0.0;                // Delta theta, by the still castor's pivot encoder, a magnitude
  std::vector<CastorOnCircle> castors;  // that of the still one is empty
};

// The revolution that a recording holds, from where the moving castors have settled. Errors say what it is not: no
// castor that stands, or none that settles.
Result<Revolution> revolution_in(const std::vector<CastorSample>& samples, const MultiCastor& nominal);

// A castor's parameters from its two runs about another pivot at distance D. `theta_perp_rad` is the true castor angle
// along the way of the clockwise run.
Castor castor_from_circles(const CastorOnCircle& clockwise, double turn_clockwise_rad,
                           const CastorOnCircle& counter_clockwise, double turn_counter_clockwise_rad,
                           double pivot_distance_m, double theta_perp_rad);

// All castors of a vehicle from runs about one castor or several; a castor that circled several gets the mean of its
// estimates. Castors without a run both ways keep their nominal values.
MultiCastor calibrated_castors(const std::vector<Revolution>& runs, const MultiCastor& nominal);

// The same from recordings, one run each, with standard errors from the rounding of the encoders.
Result<InternalCalibration> calibrate_castors(const std::vector<Recording>& recordings, const Vehicle& nominal);

}  // namespace odolab
