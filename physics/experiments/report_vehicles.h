// The other vehicles of the UMBmark report on its square, each with errors of the size that its parts have.
#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/scenario/scenario.h"

namespace odolab {

// Wheels that differ as a LabMate's do (up to 0.3 %) and stand up to 1 mrad askew, under a synchro drive.
Scenario k2a_on_report_squares(Random& random);
std::string k2a_assumption();

// Two LabMates on a link whose encoders are read without bias, round the 7 x 4 m rectangle that the report used for the
// CLAPPER (section 4.3). Uncalibrated trucks are as Table III has them; the report's vehicle was calibrated at length.
// Squares do not see a scale common to all wheels, but the link does: against its true length wheels that are taken for
// too large turn the vehicle as a link that is read too short would. `tape`: what a wheel travels on this floor for
// what it rolls, as the vehicle file knows it from a tape measure; 1 where nobody measured.
enum class Trucks { uncalibrated, calibrated };
Scenario clapper_on_report_rectangle(Random& random, Trucks trucks, double tape = 1.0);
std::string clapper_assumption();

// Driven by joystick, since "the nominal path could not even be approximated" by its odometry (section 4.4).
Scenario andros_on_report_squares();
std::string andros_assumption();

// The same vehicle with the Basic Encoder Trailer behind it; its narrow wheels are hard and made with care.
Scenario andros_with_trailer_on_report_squares(Random& random);
std::string trailer_assumption();

// The report's simulated LabMate with Smart Encoder Trailer (section 4.6.2): 337 against 340 mm, ratio 0.9985.
Scenario labmate_with_smart_trailer_on_report_squares();

// Ten 10 mm cables on the first side, under the wheels that face the inside (sections 3.4 and 3.5).
void put_ten_cables(Floor& floor);

}  // namespace odolab
