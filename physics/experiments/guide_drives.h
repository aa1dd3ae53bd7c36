// What a simulated robot drives for the guides.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/scale.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace odolab {

// One straight drive of this length beside a tape whose readings scatter by `tape_accuracy_m`. None where the robot
// never arrives or `progress` stopped it.
std::optional<TapeReading> drive_along_tape(const Scenario& scenario, double length_m, double tape_accuracy_m,
                                            std::uint64_t seed, const Progress& progress = {});

// Ten cables of 10 mm across the first side of a square, under the wheel that faces its inside (extended UMBmark).
std::vector<Bump> ten_cables(double side_m);

// The robot of the square guides on the square: the scenario with a square of this side, without bumps and slip zones,
// measured at its ends as by the sonar corner of the report (section 6.3: 2 mm and 0.4 degrees) where the scenario's
// own truth is exact.
Scenario on_guide_square(const Scenario& scenario, double side_m, int runs_each_way);

// The machine of a seed, not quite as its drawing says; unchanged for kinds that no guide calibrates from the inside.
Vehicle drawn_machine(const Vehicle& nominal, std::uint64_t seed);

// A machine that is not quite as its drawing says, and what it drives to be calibrated from the inside.
// - multi_castor: the paper's errors (Table I), each castor held still once both ways, sweeps of 1.6 rad; kinematics,
// no
//   wheel slips.
// - clapper: link encoders off by up to 15 mrad and 3 mm, wheelbases by 1 %, one wheel of each truck by 0.15 %; a
//   rectangle and manoeuvres in the planar world. Assumptions.
// Empty for other kinds, or where `progress` stopped it.
struct InsideDrives {
  Vehicle actual;
  std::vector<Recording> recordings;
};
InsideDrives drive_for_calibration_from_inside(const Vehicle& nominal, std::uint64_t seed,
                                               const Progress& progress = {});

// The machine on another way in the planar world, steered by what it is believed to be: forward, sideways while
// turning, back; its true pose is recorded. None where it never arrives. (A castor vehicle has more wheels than
// freedoms: steered by wrong numbers they push against each other and slip, and even the right numbers then find the
// way wrong.)
std::optional<Recording> drive_held_out(const Vehicle& believed, const Vehicle& actual, std::uint64_t seed,
                                        const Progress& progress = {});

}  // namespace odolab
