// Units judged against each other, where there is no outside truth to judge them by. README.md, "From the inside".
#pragma once

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/others_way.h"

namespace odolab {

// As diagnose_units, of vehicles with two units or more that drive by encoders on both sides of their joints. What all
// units do alike does not show; neither does the scale.
Result<Diagnosis> diagnose_inside(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress);

// A unit that errs, by what the units contradict each other in.
struct ErringUnit {
  std::size_t unit = 0;
  std::vector<Finding> findings;                         // in the unit's own words
  std::vector<std::vector<UnitSample>> train, held_out;  // of each recording, that taken off this unit's wheels
};

// Of units under an outside truth too coarse to see it: what lasts on one unit's wheels and can be nothing else. The
// recordings are as they are understood so far, the vehicle as that truth calibrated it. None where it is not told
// which of two units errs.
Result<std::vector<ErringUnit>> units_that_err(const std::vector<Understood>& train,
                                               const std::vector<Understood>& held_out, const Vehicle& calibrated,
                                               const DiagnosisOptions& options, const Progress& progress);

}  // namespace odolab
