// The three-castor prototype of the multi-castor paper (Doebbler, Davis, Junkins, Valasek 2008), as the experiments
// about it assume it: the paper gives its encoders and the errors of its parameters, not its dimensions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/calibration/castors.h"
#include "core/kinematics/castors.h"
#include "core/vehicle/multi_castor.h"

namespace odolab {

// R 0.24 m, r_c, d and r_w 0.05 m; encoders of 0.3 and 0.07 degrees as in section V.
MultiCastor assumed_castor_prototype();
std::string castor_prototype_assumption();

// A machine as it may be built: every parameter off by a uniform error whose mean absolute value is Table I's
// "uncalibrated" (r_c 0.21 %, r_w 2.07 %, d 0.89 %, beta 7.98 degrees). That makes the largest radius error 4.1 %: "up
// to 4 % in some cases".
MultiCastor drawn_castor_machine(const MultiCastor& nominal, std::uint64_t seed, bool with_pivot_offsets);

// Section III.A on that machine: each castor is held still once, the body turns about it both ways by `sweep_rad` after
// the other castors have come round. Sampled at 20 Hz, rounded by the encoders.
std::vector<std::vector<CastorSample>> calibration_drives(const MultiCastor& actual, const MultiCastor& nominal,
                                                          double sweep_rad, std::uint64_t seed);
// What those drives say, those that hold a revolution.
std::vector<Revolution> calibration_revolutions(const MultiCastor& actual, const MultiCastor& nominal, double sweep_rad,
                                                std::uint64_t seed);

// Moves along twists one after the other, and reads every 50 ms (20 Hz, section IV.B).
struct CastorRun {
  std::vector<CastorSample> exact;
  Pose end;
};
CastorRun castor_run(const MultiCastor& actual, const std::vector<BodyTwist>& twists);

// A square of 1.5 m with turns on the spot: 0.33 m/s and 0.75 rad/s, which are assumptions.
std::vector<BodyTwist> castor_square(bool clockwise);

// All readings of a run as the encoders round them, with one phase for each encoder.
std::vector<CastorSample> rounded(const std::vector<CastorSample>& exact, const MultiCastor& vehicle,
                                  std::uint64_t seed);

}  // namespace odolab
