// A vehicle on active split offset castors: J. Doebbler, J. J. Davis, J. L. Junkins, J. Valasek, "Odometry and
// Calibration Methods for Multi-Castor Vehicles", 2008.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/pose.h"

namespace odolab {

// Two wheels on one axle, joined to the body by a vertical pivot beside the axle. The castor's frame has its origin on
// the axle, x from there to the pivot; the left wheel is at +y. The pivot's angle is x against the body's x: zero when
// the castor trails behind a body that drives along x.
struct Castor {
  double pivot_radius_m = 0.25;  // R: of the pivot from the body's origin
  double pivot_angle_rad = 0.0;  // phi: of the pivot from the body's x axis
  double offset_m = 0.05;        // r_c: from the axle to the pivot
  double wheel_radius_left_m = 0.05;
  double wheel_radius_right_m = 0.05;
  double wheel_offset_left_m = 0.06;  // d: from the wheel to the line through the pivot
  double wheel_offset_right_m = 0.06;
  double pivot_encoder_offset_rad = 0.0;  // beta: reading minus truth

  Vec2 pivot() const {  // in the body's frame
    return {pivot_radius_m * std::cos(pivot_angle_rad), pivot_radius_m * std::sin(pivot_angle_rad)};
  }
  double track_m() const { return wheel_offset_left_m + wheel_offset_right_m; }
};

// Two castors or more; the order is that of the recording's castor1, castor2, ... The encoders are those of the paper's
// prototype, 0.3 and 0.07 degrees.
struct MultiCastor {
  static constexpr const char* kKind = "multi_castor";

  std::vector<Castor> castors;
  double wheel_encoder_resolution_rad = 0.00524;  // 0: continuous
  double pivot_encoder_resolution_rad = 0.00122;
};

std::vector<std::string> problems_in(const MultiCastor& vehicle);

// Three equal castors a third of a turn apart, the first along x: the paper's layout. It gives no dimensions; these are
// assumptions.
MultiCastor three_castor_vehicle();

}  // namespace odolab
