// UMBmark: the benchmark and the calibration of a differential drive from bidirectional squares.
// J. Borenstein, L. Feng, "UMBmark", University of Michigan, UM-MEAM-94-22, 1994. Equation numbers are the report's.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/pose.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// Absolute minus calculated pose at the end of one run (Eq. 3.1), in the frame in which the square starts along x.
struct ReturnError {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

// The runs of one experiment.
struct UmbmarkRuns {
  double side_m = 4.0;
  std::vector<ReturnError> clockwise;
  std::vector<ReturnError> counter_clockwise;
};

// The return position errors of one direction.
struct Cluster {
  Vec2 centre_of_gravity;         // Eq. 3.2
  double distance_m = 0.0;        // r_c.g., Eq. 3.3
  double mean_heading_rad = 0.0;  // Eq. 3.6
  double spread_m = 0.0;          // estimated standard deviation of the positions: sqrt(var x + var y)
  double standard_error_m = 0.0;  // SEM = spread / sqrt(n)
};

// The measure of dead-reckoning accuracy.
struct UmbmarkMeasure {
  Cluster clockwise;
  Cluster counter_clockwise;
  double largest_systematic_error_m = 0.0;  // Emax,syst, Eq. 3.4
  double spread_m = 0.0;                    // of both directions pooled
  double standard_error_m = 0.0;            // SEM of the worse direction's centre from the pooled spread
  // The rule of thumb of section 6.3: below 3 SEM a further compensation is unlikely to help. True where one run a
  // direction leaves nothing to judge by.
  bool worth_compensating = true;
};

// Each direction needs one run or more, two for a spread.
std::optional<UmbmarkMeasure> measure_umbmark(const UmbmarkRuns& runs);

// Heading errors of the two types: alpha in each corner (type A, > 0: turns too little), beta on each side (type B,
// > 0: curves to the left, in both directions of the square).
struct TypeErrors {
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
};

// Where a robot with these errors ends a square that it believes to have closed: four arcs of the side's length and
// four turns, each of which also shifts the centre a little since the wheels are unequal (Appendix A). README, Eq. 1.
// The robot's true wheelbase only matters for that shift.
ReturnError square_return_error(const TypeErrors& errors, double side_m, bool clockwise, double wheelbase_m);

// What the two clusters say about the vehicle.
struct UmbmarkCalibration {
  TypeErrors from_x;                  // Eqs. 6.26a, 6.22a
  TypeErrors from_y;                  // Eqs. 6.26b, 6.22b
  TypeErrors printed;                 // the mean of both: all four coordinates, to first order as in the report
  TypeErrors exact;                   // least squares over all four coordinates on the exact path; used below
  double residual_m = 0.0;            // what alpha and beta together leave of the four coordinates, root mean square
  double curvature_radius_m = 0.0;    // R, Eq. 6.23, the side being the arc and not its chord; infinite where straight
  double wheel_diameter_ratio = 1.0;  // Ed = D_R / D_L, Eq. 6.24
  double wheelbase_ratio = 1.0;       // Eb = b_actual / b_nominal, Eq. 6.29
  double left_factor = 1.0;           // c_L, Eq. 6.33
  double right_factor = 1.0;          // c_R, Eq. 6.34
  // Standard errors from the spread of the runs; zero where there is one run a direction.
  double wheel_diameter_ratio_stderr = 0.0;
  double wheelbase_ratio_stderr = 0.0;
  DifferentialDrive corrected;  // Eqs. 6.28 and 6.35 applied to the nominal drive; the mean diameter stays (6.30)
};

std::optional<UmbmarkCalibration> calibrate_umbmark(const UmbmarkRuns& runs, const DifferentialDrive& nominal);

// What the square in one direction alone would conclude, and why it deceives (section 3.1): the wheelbase that makes
// that direction's return error least, with the wheels left alone.
struct OneDirectionCalibration {
  double wheelbase_ratio = 1.0;
  double predicted_error_this_way_m = 0.0;   // what it promises
  double predicted_error_other_way_m = 0.0;  // what the other direction then shows, if both alpha and beta are as found
};
std::optional<OneDirectionCalibration> calibrate_one_direction(const UmbmarkRuns& runs, bool clockwise,
                                                               const DifferentialDrive& nominal);

// Extended UMBmark: the susceptibility to bumps as the average absolute heading error without its bias, Eqs. 3.5, 3.6.
// The average is over all runs of both directions; each direction needs one run or more on either floor.
struct ExtendedUmbmark {
  double mean_absolute_heading_error_rad = 0.0;
  double systematic_bias_clockwise_rad = 0.0;
  double systematic_bias_counter_clockwise_rad = 0.0;
};
std::optional<ExtendedUmbmark> measure_extended_umbmark(const UmbmarkRuns& smooth, const UmbmarkRuns& with_bumps);

}  // namespace odolab
