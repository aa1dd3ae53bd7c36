// LabMates as the UMBmark report had them on its squares, with the errors that its Table III shows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/calibration/umbmark.h"
#include "core/scenario/scenario.h"

namespace odolab {

constexpr double kReportSide_m = 4.0;

// The report's square and sonar corner (section 6.3): 4 m at 0.2 m/s, five runs each way, 2 mm and 0.4 degrees.
Scenario on_report_squares();

// A floor that scatters a LabMate's return positions by the 25 mm of section 6.3. An assumption: the report gives the
// scatter and not the floor. The bumps of its own simulation (1 mm every 2 cm) scatter by 9 mm here, and it calls them
// "not very effective" itself (section 4.6.2).
Roughness report_floor();
std::string report_floor_assumption();

// How far a LabMate's wheel travels on that floor for what it rolls: bumps make it roll further. What a tape measure
// would show (Appendix B).
double travelled_per_rolled_on_report_floor();

// Wheels of these diameters' ratio D_R / D_L with the nominal mean, and the actual wheelbase over the nominal one.
Scenario labmate_on_report_squares(double diameter_ratio, double wheelbase_ratio);

// Heading errors of a robot with these ratios: alpha by Eq. 6.28, beta from the arc that unequal wheels drive (6.24).
TypeErrors type_errors(double diameter_ratio, double wheelbase_ratio, double nominal_wheelbase_m = 0.340);
// The distance of the worse direction's centre of gravity to first order: x and y are off by 2 L (|alpha| + |beta|)
// each, Eqs. 6.19 and 6.20.
double first_order_largest_error_m(const TypeErrors& errors, double side_m = kReportSide_m);

// Robots drawn with up to 0.3 % between the wheels and 1 % in the wheelbase, kept where Emax,syst by
// the first-order formulas lies as in Table III.
std::vector<Scenario> labmates_of_table3(int count, std::uint64_t seed);

}  // namespace odolab
