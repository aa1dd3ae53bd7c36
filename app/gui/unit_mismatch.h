// How far each unit of a vehicle is off along a recording, for pictures. A differential drive is one unit.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/mismatch.h"
#include "core/vehicle/vehicle.h"
#include "ui/floor/trail.h"

namespace odolab {

struct UnitMismatch {
  std::string unit;  // "truck_b"; empty: the vehicle itself, or the one that tows
  MismatchOverTime mismatch;
  double mean_square = 0.0;  // of what calibration leaves
  ui::Trail trail;
};

// The diagnosis with the residuals of held-out recordings beside those of the fitted ones, of every unit, so that their
// mismatch can be drawn too.
Diagnosis with_held_out_units(const Diagnosis& diagnosis, const std::vector<Recording>& fitted,
                              const std::vector<Recording>& held_out, const Vehicle& nominal);

// Of each unit whose residuals the diagnosis has of this recording, in the order of the vehicle's units; of none where
// nothing can be drawn.
std::vector<UnitMismatch> unit_mismatches(const Diagnosis& diagnosis, const std::string& recording,
                                          const Vehicle& nominal);

}  // namespace odolab
